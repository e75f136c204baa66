#include "controller/axis_mover.h"

#include <algorithm>
#include <cmath>

#include "controller/alarms.h"
#include "controller/feed_time.h"
#include "controller/surface_speed.h"
#include "motion/tool_centre_point.h"

namespace trunnion::controller {

namespace {

/// Path length of the tip with the rotary axes at rest.
double linear_length(const motion::AxisMove& m) {
    return (m.parallel.linear(m.to) - m.parallel.linear(m.from)).norm();
}

/// The arc in machine coordinates. A mirror image reverses its direction.
motion::ArcPath arc_in_machine(const Frames& frames, const ProgramArc& arc,
                               motion::MotionKind& kind) {
    motion::ArcPath path;
    const Matrix3& linear = frames.stages.linear();
    const Vector3 start = offsets::xyz_of(frames.program), gauge = offsets::xyz_of(frames.machine);
    if (frames.stages.is_shift()) {
        path.centre_mm = arc.centre + (gauge - start);
        path.normal = arc.normal;
        path.sweep_rad = arc.sweep_rad;
    } else {
        path.centre_mm = linear * (arc.centre - start) + gauge;
        const double side = linear.determinant() < 0.0 ? -1.0 : 1.0;
        path.normal = (linear * arc.normal).normalized();
        path.sweep_rad = side * arc.sweep_rad;
        if (side < 0.0 && path.normal.dot(arc.normal) > 0.0)
            kind = kind == motion::MotionKind::arc_ccw ? motion::MotionKind::arc_cw
                                                       : motion::MotionKind::arc_ccw;
    }
    path.turns = motion::turns_of(path.sweep_rad);
    return path;
}

}  // namespace

AxisMover::AxisMover(const SortedWords& words, Modal& modal, Frames& frames,
                     motion::MotionSink& sink)
    : words_(words), modal_(modal), frames_(frames), sink_(sink) {}

void AxisMover::configure(const ControlConfig& config) {
    limits = axis_limits(config.axes);
    clamps_ = config.clamps;
    const bool hurco = config.dialect.family == interpreter::DialectFamily::hurco;
    for (const auto& [axis, m_clamp] : hurco_clamps)
        if (hurco && config.hurco.clamps_alarm)
            clamps_.push_back({axis, m_clamp, m_clamp + 1, true});
}

void AxisMover::parameters_changed() {
    set_corner_jumps(modal_.settings, limits);
    move_.parallel = frames_.believed.parallel;
}

void AxisMover::start_run() {
    record = {};
    move_.arc.reset();
    move_.curve = nullptr;
    move_.until_skip = false;
    pace_.stop();
}

void AxisMover::check_stroke(const AxisPositions& to) const {
    for (std::size_t i = 0; i < axis_count; ++i) {
        if (to.value[i] <= limits.max[i] && to.value[i] >= limits.min[i]) continue;
        const char letter = letter_of(all_axes[i]);
        raise_alarm(to.value[i] > limits.max[i] ? 500 : 501, std::string(1, letter),
                    words_.column_of(letter));
    }
}

void AxisMover::check_clamps(const AxisPositions& to) const {
    for (const ClampCode& clamp : clamps_) {
        const std::size_t i = index_of(clamp.axis);
        const char letter = letter_of(clamp.axis);
        if (clamp.alarm && clamped_[i] && to.value[i] != frames_.axes.value[i])
            raise_alarm(9001, std::string(1, letter), words_.column_of(letter));
    }
}

double AxisMover::duration(motion::MotionKind kind, double way) const {
    const double shortest = rapid_time(limits, move_.from, move_.to);
    if (kind == motion::MotionKind::rapid) return shortest;
    return std::max(commanded_time(modal_.block.feed, way, words_.column_of('F')), shortest);
}

/// Copies data of modal state and frames into the move.
void AxisMover::take_marks() {
    const motion::BlockMarks& marks = modal_.block;
    move_.spindle_rpm = marks.spindle_rpm;
    move_.coolant = marks.coolant;
    move_.gap_free = marks.gap_free;
    move_.tool = marks.tool;
    move_.line = marks.line;
    move_.byte = marks.byte;
    move_.program = marks.program;
    move_.tool_offset = frames_.tool.number;
    move_.tool_vector_mm = frames_.tool.vector_mm;
    move_.mode = frames_.mode(modal_.settings);
    move_.transform = frames_.believed.transform ? &*frames_.believed.transform : nullptr;
}

/// A rapid without interpolation; empty when all axes arrive together.
std::optional<motion::Dogleg> AxisMover::dogleg_of(const motion::AxisMove& move) const {
    if (!modal_.settings.rapids_are_doglegs) return std::nullopt;
    std::optional<motion::Dogleg> way(std::in_place, move.from, move.to, limits);
    if (way->is_straight()) way.reset();
    return way;
}

/// Completes `move_` with the marks and sends it. `way`: path length to which F refers, mm.
motion::MoveResult AxisMover::send(motion::MotionKind kind, const offsets::ControlPosition& program,
                                   const offsets::ControlPosition& machine, double way) {
    motion::AxisMove& m = move_;
    m.kind = kind;
    check_stroke(m.to);
    if (!clamps_.empty()) check_clamps(m.to);
    take_marks();
    const double cruise_s = pace_.take(m, limits, way);
    const bool on_its_own = kind == motion::MotionKind::rapid && !m.curve && !m.arc;
    const std::optional<motion::Dogleg> dogleg = on_its_own ? dogleg_of(m) : std::nullopt;
    if (dogleg) m.curve = &*dogleg;
    m.feed_mm_min = kind == motion::MotionKind::rapid ? 0.0
                    : m.length_mm > 0.0 && cruise_s > 0
                        ? 60.0 * m.length_mm / cruise_s
                        : modal_.block.feed.mm_min / modal_.units.unit_mm;
    const motion::MoveResult result = sink_.move(m);
    if (dogleg) m.curve = nullptr;
    ++record.moves;
    record.time_s += result.part * m.duration_s;
    record.path_mm += result.part * m.length_mm;
    if (result.skipped) {
        frames_.axes = result.stopped;
        frames_.machine = offsets::control_position_of(result.stopped);
        frames_.program = frames_.program_at(frames_.machine);
        return result;
    }
    frames_.axes = m.to;
    frames_.machine = machine;
    frames_.program = program;
    frames_.length_parked = false;
    frames_.tip.keeps_program = false;
    return result;
}

motion::MoveResult AxisMover::straight(motion::MotionKind kind,
                                       const offsets::ControlPosition& target) {
    const offsets::ControlPosition machine = frames_.stages.machine_from_program(target);
    motion::AxisMove& m = move_;
    m.from = frames_.axes;
    m.to = offsets::axis_positions_of(machine);
    if (m.to == m.from) {  // no motion: nothing is sent
        frames_.machine = machine;
        frames_.program = target;
        return {};
    }
    m.length_mm = linear_length(m);
    if (modal_.spindle.by_surface) follow_surface_speed(modal_, frames_.program, target);
    const double way = std::sqrt(feed_square(frames_.machine, machine, modal_.units.unit_mm));
    m.duration_s = duration(kind, way);
    return send(kind, target, machine, way);
}

void AxisMover::to_machine(motion::MotionKind kind, const offsets::ControlPosition& target) {
    motion::AxisMove& m = move_;
    m.from = frames_.axes;
    m.to = offsets::axis_positions_of(target);
    const offsets::ControlPosition program = frames_.program_at(target);
    if (m.to == m.from) {
        frames_.machine = target;
        frames_.program = program;
        return;
    }
    m.length_mm = linear_length(m);
    const double way = std::sqrt(feed_square(frames_.machine, target, modal_.units.unit_mm));
    m.duration_s = duration(kind, way);
    send(kind, program, target, way);
}

void AxisMover::arc(motion::MotionKind kind, const offsets::ControlPosition& target,
                    const ProgramArc& arc) {
    const offsets::ControlPosition machine = frames_.stages.machine_from_program(target);
    motion::AxisMove& m = move_;
    m.from = frames_.axes;
    m.to = offsets::axis_positions_of(machine);
    const motion::ArcPath path = arc_in_machine(frames_, arc, kind);
    m.length_mm =
        motion::arc_length_mm(path, offsets::xyz_of(frames_.machine), offsets::xyz_of(machine));
    if (modal_.spindle.by_surface) follow_surface_speed(modal_, frames_.program, target);
    const double way = std::sqrt(m.length_mm * m.length_mm +
                                 feed_square(frames_.machine, machine, modal_.units.unit_mm, 3));
    m.duration_s = duration(kind, way);
    m.arc = path;
    send(kind, target, machine, way);
    m.arc.reset();
}

motion::MoveResult AxisMover::along(motion::MotionKind kind, const MoveTarget& target,
                                    const CurveMove& way) {
    motion::AxisMove& m = move_;
    m.from = frames_.axes;
    m.to = target.axes;
    if (m.to == m.from && !way.arc) {
        frames_.machine = target.machine;
        frames_.program = target.program;
        return {};
    }
    m.length_mm = way.length_mm;
    if (modal_.spindle.by_surface) follow_surface_speed(modal_, frames_.program, target.program);
    m.duration_s = duration(kind, way.feed_length_mm);
    if (way.curve) {
        m.curve = way.curve;
        // Between its ends the path may exceed a limit that neither end exceeds.
        const int parts = motion::curve_parts(m.from, m.to);
        for (int k = 1; k < parts; ++k) check_stroke(way.curve->at(static_cast<double>(k) / parts));
    }
    if (way.arc) m.arc = *way.arc;
    const motion::MoveResult result =
        send(kind, target.program, target.machine, way.feed_length_mm);
    m.curve = nullptr;
    m.arc.reset();
    return result;
}

void AxisMover::dwell(double duration_s) {
    pace_.stop();
    record.time_s += duration_s;
    sink_.dwell(duration_s);
}

void AxisMover::m_code(int code) {
    pace_.stop();
    sink_.m_code(code);
}

}  // namespace trunnion::controller

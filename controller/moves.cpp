#include "controller/moves.h"

#include <algorithm>
#include <cmath>

#include "controller/feed_time.h"
#include "controller/five_axis.h"
#include "controller/surface_speed.h"

namespace trunnion {

namespace {

/// Way of the tip while the rotaries stand.
double linear_length(const AxisMove& m) {
    return (m.parallel.linear(m.to) - m.parallel.linear(m.from)).norm();
}

[[noreturn]] void raise_overtravel(const ControlState& c, std::size_t i, const AxisPositions& to) {
    const char letter = letter_of(all_axes[i]);
    raise_alarm(to.value[i] > c.limits.max[i] ? 500 : 501, std::string(1, letter),
                c.words.column_of(letter));
}

void check_clamps(const ControlState& c, const AxisPositions& to) {
    for (const ClampCode& clamp : c.config.clamps) {
        const std::size_t i = index_of(clamp.axis);
        if (clamp.alarm && c.clamped[i] && to.value[i] != c.move.from.value[i])
            raise_alarm(9001, std::string(1, letter_of(clamp.axis)),
                        c.words.column_of(letter_of(clamp.axis)));
    }
}

/// Everything is in c.move but the place: sends it and keeps where the axes stopped. `way`: what F
/// divides, mm.
MoveResult send(ControlState& c, MotionKind kind, const ControlPosition& target,
                const ControlPosition& machine_target, double way) {
    AxisMove& m = c.move;
    m.kind = kind;
    check_stroke(c, m.to);
    if (!c.config.clamps.empty()) check_clamps(c, m.to);
    const double cruise_s = c.pace.take(m, c.limits, way);
    m.feed_mm_min = kind == MotionKind::rapid           ? 0.0
                    : m.length_mm > 0.0 && cruise_s > 0 ? 60.0 * m.length_mm / cruise_s
                                                        : c.feed.mm_min / c.unit_mm;
    const MoveResult result = c.sink.move(m);
    ++c.result.moves;
    c.result.time_s += result.part * m.duration_s;
    c.result.path_mm += result.part * m.length_mm;
    if (result.skipped) {
        c.machine = control_position_of(result.stopped);
        m.from = m.to = result.stopped;
        c.program = c.program_at(c.machine);
        return result;
    }
    m.from = m.to;
    c.machine = machine_target;
    c.program = target;
    c.length_parked = false;
    return result;
}

}  // namespace

void check_stroke(const ControlState& c, const AxisPositions& to) {
    for (std::size_t i = 0; i < axis_count; ++i)
        if (to.value[i] > c.limits.max[i] || to.value[i] < c.limits.min[i])
            raise_overtravel(c, i, to);
}

MoveResult move_line(ControlState& c, MotionKind kind, const ControlPosition& target) {
    return c.five_axis.active ? move_five_axis(c, kind, target) : move_straight(c, kind, target);
}

MoveResult move_straight(ControlState& c, MotionKind kind, const ControlPosition& target) {
    const ControlPosition machine_target = c.coordinates.machine_from_program(target);
    AxisMove& m = c.move;
    m.to = axis_positions_of(machine_target);
    if (m.to == m.from) {  // no way to go: nothing goes out
        c.machine = machine_target;
        c.program = target;
        return {};
    }
    m.length_mm = linear_length(m);
    if (c.spindle.by_surface) follow_surface_speed(c, target);
    const double way = feed_length(c, machine_target);
    m.duration_s = kind == MotionKind::rapid ? rapid_time(c.limits, m.from, m.to)
                                             : cutting_time(c, way, m.from, m.to);
    return send(c, kind, target, machine_target, way);
}

void move_machine(ControlState& c, MotionKind kind, const ControlPosition& target) {
    AxisMove& m = c.move;
    m.to = axis_positions_of(target);
    const ControlPosition program = c.program_at(target);
    if (m.to == m.from) {
        c.machine = target;
        c.program = program;
        return;
    }
    m.length_mm = linear_length(m);
    const double way = feed_length(c, target);
    m.duration_s = kind == MotionKind::rapid ? rapid_time(c.limits, m.from, m.to)
                                             : cutting_time(c, way, m.from, m.to);
    send(c, kind, program, target, way);
}

void move_arc(ControlState& c, MotionKind kind, const ControlPosition& target,
              const ProgramArc& arc) {
    if (c.five_axis.active && move_five_axis_arc(c, kind, target, arc)) return;
    const ControlPosition machine_target = c.coordinates.machine_from_program(target);
    AxisMove& m = c.move;
    m.to = axis_positions_of(machine_target);
    ArcPath path;
    const Matrix3& linear = c.coordinates.linear();
    const Vector3 start = xyz_of(c.program);
    if (c.coordinates.is_shift()) {
        path.centre_mm = arc.centre + (xyz_of(c.machine) - start);
        path.normal = arc.normal;
        path.sweep_rad = arc.sweep_rad;
    } else {
        path.centre_mm = linear * (arc.centre - start) + xyz_of(c.machine);
        const double side =
            linear.determinant() < 0.0 ? -1.0 : 1.0;  // a mirror turns the arc round
        path.normal = (linear * arc.normal).normalized();
        path.sweep_rad = side * arc.sweep_rad;
        if (side < 0.0 && path.normal.dot(arc.normal) > 0.0)
            kind = kind == MotionKind::arc_ccw ? MotionKind::arc_cw : MotionKind::arc_ccw;
    }
    path.turns = turns_of(path.sweep_rad);
    const Vector3 radius_vector = xyz_of(c.machine) - path.centre_mm;
    const double rise = path.normal.dot(xyz_of(machine_target) - xyz_of(c.machine));
    const double radius = (radius_vector - radius_vector.dot(path.normal) * path.normal).norm();
    const double bow = radius * path.sweep_rad;
    m.length_mm = std::sqrt(bow * bow + rise * rise);
    if (c.spindle.by_surface) follow_surface_speed(c, target);
    const double way = std::sqrt(m.length_mm * m.length_mm + feed_square(c, machine_target, 3));
    m.duration_s = cutting_time(c, way, m.from, m.to);
    m.arc = path;
    send(c, kind, target, machine_target, way);
    m.arc.reset();
}

MoveResult move_along(ControlState& c, MotionKind kind, const ControlPosition& target,
                      const ControlPosition& machine_target, const AxisPositions& to,
                      const CurveMove& way) {
    AxisMove& m = c.move;
    m.to = to;
    if (m.to == m.from && !way.arc) {
        c.machine = machine_target;
        c.program = target;
        return {};
    }
    m.length_mm = way.length_mm;
    if (c.spindle.by_surface) follow_surface_speed(c, target);
    m.duration_s = kind == MotionKind::rapid ? rapid_time(c.limits, m.from, m.to)
                                             : cutting_time(c, way.feed_length_mm, m.from, m.to);
    if (way.curve) {
        m.curve = way.curve;
        // The axes may swing further out on the way than where they end.
        const int parts = curve_parts(m.from, m.to);
        for (int k = 1; k < parts; ++k)
            check_stroke(c, way.curve->at(static_cast<double>(k) / parts));
    }
    if (way.arc) m.arc = *way.arc;
    const MoveResult result = send(c, kind, target, machine_target, way.feed_length_mm);
    m.curve = nullptr;
    m.arc.reset();
    return result;
}

MoveResult move_curve(ControlState& c, MotionKind kind, const ControlPosition& target,
                      const ControlPosition& machine_target, const PathCurve& curve,
                      double length_mm) {
    CurveMove way;
    way.curve = &curve;
    way.length_mm = way.feed_length_mm = length_mm;
    return move_along(c, kind, target, machine_target, axis_positions_of(machine_target), way);
}

void dwell(ControlState& c, double duration_s) {
    c.pace.stop();
    c.result.time_s += duration_s;
    c.sink.dwell(duration_s);
}

}  // namespace trunnion

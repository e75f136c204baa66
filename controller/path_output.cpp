// Compensated moves on their way out: some are held back, so that the interference check sees
// several sides before the first of them goes out.
#include <algorithm>

#include "controller/compensated_corner.h"
#include "controller/control_state.h"
#include "controller/moves.h"
#include "geometry/plane_crossing.h"

namespace trunnion {

namespace {

void move_out(ControlState& c, const PathOutput& out) {
    c.program = out.from;
    const PlaneElement& way = out.way;
    if (!way.arc)
        return void(move_line(c, out.move.rapid ? MotionKind::rapid : MotionKind::linear, out.to));
    const PlaneAxes& plane = plane_axes(c.modal);
    ProgramArc arc;
    arc.centre = xyz_of(c.program);
    arc.centre[static_cast<Eigen::Index>(index_of(plane.first))] = way.centre.x;
    arc.centre[static_cast<Eigen::Index>(index_of(plane.second))] = way.centre.y;
    arc.normal = Vector3::Unit(static_cast<Eigen::Index>(index_of(plane.normal)));
    arc.sweep_rad = way.sweep_rad;
    move_arc(c, way.sweep_rad < 0.0 ? MotionKind::arc_cw : MotionKind::arc_ccw, out.to, arc);
}

/// Puts the states of a block in force; returns those that were.
BlockMarks exchange_marks(ControlState& c, const BlockMarks& marks) {
    AxisMove& m = c.move;
    const BlockMarks before{c.feed, m.spindle_rpm, m.coolant, m.gap_free,
                            m.tool, m.line,        m.byte,    m.program};
    c.feed = marks.feed;
    m.spindle_rpm = marks.spindle_rpm;
    m.coolant = marks.coolant;
    m.gap_free = marks.gap_free;
    m.tool = marks.tool;
    m.line = marks.line;
    m.byte = marks.byte;
    m.program = marks.program;
    return before;
}

/// The move with the states of its block, which may lie behind the one that runs now.
void emit(ControlState& c, const PathOutput& out) {
    if (out.m_code >= 0) return c.send_m_code(out.m_code);
    if (out.dwell_s >= 0.0) return dwell(c, out.dwell_s);
    const ControlPosition programmed = c.program;
    const BlockMarks now = exchange_marks(c, out.move.marks);
    try {
        move_out(c, out);
    } catch (Alarm& alarm) {
        place_alarm(alarm, out.move.marks);
        c.path.ahead.clear();
        throw;
    }
    exchange_marks(c, now);
    c.program = programmed;
}

/// The ways of two sides that do not touch as programmed may not cross: the cutter would cut into
/// one of them. Which of the control's own tests finds this is assumed.
void check_crossing(const PathQueue& q, const PathOutput& next) {
    for (const PathOutput& earlier : q.ahead)
        if (earlier.beside && earlier.block != next.block &&
            !touch(earlier.move.plane, next.move.plane) && cross_over(earlier.way, next.way))
            raise_alarm(41);
}

void push(ControlState& c, const PathOutput& out) {
    PathQueue& q = c.path;
    q.ahead.push_back(out);
    constexpr std::size_t most = 256;  // a contour of depth moves alone holds nothing back for ever
    const bool hold = (out.beside || !out.move.plane.moves()) && q.ahead.size() < most;
    const auto held = static_cast<std::uint64_t>(hold ? c.settings.blocks_ahead : 0);
    std::size_t done = 0;
    while (done < q.ahead.size() && q.ahead[done].block + held <= q.block) emit(c, q.ahead[done++]);
    q.ahead.erase(q.ahead.begin(), q.ahead.begin() + static_cast<std::ptrdiff_t>(done));
}

}  // namespace

void place_alarm(Alarm& alarm, const BlockMarks& marks) {
    if (alarm.where.line != 0) return;
    if (marks.program) alarm.where.program = *marks.program;
    alarm.where.line = marks.line;
    alarm.where.column = 1;  // the words at hand are those of a later block
}

void send_path(ControlState& c, const PathMove& move, const PlaneElement& way,
               const ControlPosition& to, bool beside) {
    PathOutput out;
    out.move = move;
    out.way = way;
    out.from = out.to = c.path.tool;
    out.beside = beside;
    out.block = c.path.block;
    const PlaneAxes& plane = plane_axes(c.modal);
    out.to = to;
    out.to[plane.first] = way.end.x;
    out.to[plane.second] = way.end.y;
    if (beside) check_crossing(c.path, out);
    c.path.tool = out.to;
    push(c, out);
}

void send_event(ControlState& c, const PathOutput& event) {
    if (c.path.ahead.empty()) return emit(c, event);
    PathOutput out = event;
    out.block = c.path.block;
    out.beside = false;
    c.path.ahead.push_back(out);
}

void release_path(ControlState& c) {
    const std::vector<PathOutput> ahead = std::move(c.path.ahead);
    c.path.ahead.clear();
    for (const PathOutput& out : ahead) emit(c, out);
}

}  // namespace trunnion

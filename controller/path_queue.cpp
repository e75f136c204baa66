#include "controller/path_queue.h"

#include <cmath>

#include "controller/arcs.h"
#include "controller/control_state.h"
#include "controller/moves.h"
#include "geometry/plane_crossing.h"

namespace trunnion {

namespace {

/// Point of the element at `way` mm from its end (or start), along it.
PlanePoint before_end(const PlaneElement& e, double way) {
    if (!e.arc) return e.end - way * tangent_at_end(e);
    const double turn = -std::copysign(way / e.radius(), e.sweep_rad);
    const PlanePoint r = e.end - e.centre;
    return e.centre + std::cos(turn) * r + std::sin(turn) * left_of(r);
}
PlanePoint after_start(const PlaneElement& e, double way) {
    PlaneElement back = e;
    std::swap(back.start, back.end);
    back.sweep_rad = -e.sweep_rad;
    return before_end(back, way);
}

/// Foot on the element of a point at a distance from it.
PlanePoint foot_on(const PlaneElement& e, PlanePoint p) {
    if (!e.arc) {
        const PlanePoint t = tangent_at_start(e);
        return e.start + dot(p - e.start, t) * t;
    }
    const PlanePoint r = p - e.centre;
    return e.centre + (e.radius() / length_of(r)) * r;
}

void set_plane(const ControlState& c, ControlPosition& p, PlanePoint point) {
    const PlaneAxes& plane = plane_axes(c.modal);
    p[plane.first] = point.x;
    p[plane.second] = point.y;
}

/// The piece between two sides: a chamfer or an arc that touches both.
PlaneElement corner_piece(const PathMove& first, const PathMove& second) {
    PlaneElement piece;
    const PlaneElement &a = first.plane, &b = second.plane;
    if (first.chamfer) {
        piece.start = before_end(a, first.corner_mm);
        piece.end = after_start(b, first.corner_mm);
        return piece;
    }
    const double turn = cross(tangent_at_end(a), tangent_at_start(b));
    const double side = turn < 0.0 ? -first.corner_mm : first.corner_mm;
    const auto centre = offset_meeting(a, side, b, side, a.end);
    if (!centre) raise_alarm(55);
    piece.arc = true;
    piece.centre = *centre;
    piece.start = foot_on(a, *centre);
    piece.end = foot_on(b, *centre);
    piece.sweep_rad = sweep_of(piece.centre, piece.start, piece.end, turn < 0.0);
    return piece;
}

/// Both sides are shortened and the corner comes between them; straight on there is none.
void make_corner(ControlState& c, PathMove first, PathMove& second) {
    if (second.rapid) raise_alarm(52);
    const double turn = cross(tangent_at_end(first.plane), tangent_at_start(second.plane));
    if (std::abs(turn) > 1e-9) {
        PathMove corner = first;
        corner.plane = corner_piece(first, second);
        if (!within(first.plane, corner.plane.start, 1e-6) ||
            !within(second.plane, corner.plane.end, 1e-6))
            raise_alarm(55);
        first.plane = between(first.plane, first.plane.start, corner.plane.start);
        set_plane(c, first.to, corner.plane.start);
        set_plane(c, corner.to, corner.plane.end);
        second.plane = between(second.plane, corner.plane.end, second.plane.end);
        first.chamfer = first.round = corner.chamfer = corner.round = false;
        compensate(c, first);
        compensate(c, corner);
        return;
    }
    first.chamfer = first.round = false;
    compensate(c, first);
}

BlockMarks marks_of(const ControlState& c) {
    BlockMarks marks;
    marks.feed = c.feed;
    marks.spindle_rpm = c.move.spindle_rpm;
    marks.coolant = c.move.coolant;
    marks.gap_free = c.move.gap_free;
    marks.tool = c.move.tool;
    marks.line = c.words.line;
    marks.byte = c.words.byte;
    marks.program = c.move.program;
    return marks;
}

void queue_event(ControlState& c, PathOutput event) {
    PathQueue& q = c.path;
    if (q.corner) raise_alarm(51);
    event.move.marks = marks_of(c);
    if (q.first)
        q.idle.push_back(event);
    else
        send_event(c, event);
}

}  // namespace

bool uses_path_queue(const ControlState& c) {
    return c.path.engaged || c.words.corner_radius || c.words.corner_chamfer;
}

PathMove path_move_of(ControlState& c, const ControlPosition& target, bool clockwise, bool arc) {
    const PlaneAxes& plane = plane_axes(c.modal);
    PathMove m;
    m.plane.start = {c.program[plane.first], c.program[plane.second]};
    m.plane.end = {target[plane.first], target[plane.second]};
    if (arc) {
        const ArcInPlane found = arc_in_plane(c, target, clockwise);
        m.plane.arc = found.is_arc;
        m.plane.centre = found.centre;
        m.plane.sweep_rad = found.sweep_rad;
    }
    m.to = target;
    m.rapid = c.modal.is(ModalGroup::motion, 0);
    m.offset_mm = c.cutter_offset_mm();
    m.chamfer = c.words.corner_chamfer;
    m.round = c.words.corner_radius;
    m.corner_mm = c.words.corner;
    m.marks = marks_of(c);
    return m;
}

void queue_move(ControlState& c, const PathMove& move) {
    PathQueue& q = c.path;
    if (!q.engaged) {
        q.engaged = true;
        q.tool = c.program;
    }
    PathMove m = move;
    c.program = m.to;
    if (q.corner) {
        if (!m.plane.moves()) raise_alarm(51);
        const PathMove first = *q.corner;
        q.corner.reset();
        make_corner(c, first, m);
    }
    if ((m.chamfer || m.round) && m.corner_mm > 0.0 && m.plane.moves())
        q.corner = m;
    else
        compensate(c, m);
    q.engaged = q.engaged || q.corner.has_value();
}

void queue_dwell(ControlState& c, double duration_s) {
    if (!c.path.engaged) return dwell(c, duration_s);
    PathOutput event;
    event.dwell_s = duration_s;
    queue_event(c, event);
}

void queue_m_code(ControlState& c, int code) {
    if (!c.path.engaged) return c.send_m_code(code);
    PathOutput event;
    event.m_code = code;
    queue_event(c, event);
}

void flush_path(ControlState& c) {
    if (!c.path.engaged) return;
    if (c.path.corner) raise_alarm(51);
    flush_compensation(c);
    release_path(c);
}

void pause_path(ControlState& c) {
    flush_path(c);
    c.path.paused = true;
    for (std::size_t i = 0; i < axis_count; ++i)
        c.path.programmed_from_tool.value[i] = c.program.value[i] - c.path.tool.value[i];
    c.program = c.path.tool;
}

void resume_path(ControlState& c, bool axes_moved) {
    c.path.paused = false;
    c.path.tool = c.program;
    if (axes_moved) {  // G28, G53 and the like: compensation starts anew
        c.path.last_offset_mm = 0.0;
        return;
    }
    for (std::size_t i = 0; i < axis_count; ++i)
        c.program.value[i] += c.path.programmed_from_tool.value[i];
}

}  // namespace trunnion

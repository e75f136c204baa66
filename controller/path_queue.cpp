#include "controller/path_queue.h"

#include <cmath>

#include "controller/arcs.h"
#include "controller/control_state.h"
#include "controller/moves.h"

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

bool on_element(const PlaneElement& e, PlanePoint p) {
    constexpr double slack = 1e-6;
    if (!e.arc) {
        const double s = dot(p - e.start, tangent_at_start(e));
        return s > -slack && s < length_of(e.end - e.start) + slack;
    }
    const PlaneElement part = between(e, e.start, p);
    return std::abs(part.sweep_rad) < std::abs(e.sweep_rad) + slack / e.radius() &&
           part.sweep_rad * e.sweep_rad >= 0.0;
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
        if (!on_element(first.plane, corner.plane.start) ||
            !on_element(second.plane, corner.plane.end))
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
    m.feed_mm_min = c.feed.mm_min;
    m.seconds_per_mm = c.feed.seconds_per_mm;
    m.line = c.words.line;
    m.byte = c.words.byte;
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

void flush_path(ControlState& c) {
    if (!c.path.engaged) return;
    if (c.path.corner) raise_alarm(51);
    flush_compensation(c);
}

void send_path(ControlState& c, const PathMove& move, const PlaneElement& way,
               const ControlPosition& to) {
    const ControlPosition programmed = c.program;
    const FeedState feed = c.feed;
    c.program = c.path.tool;
    c.feed.mm_min = move.feed_mm_min;
    c.feed.seconds_per_mm = move.seconds_per_mm;
    c.move.line = move.line;
    c.move.byte = move.byte;
    ControlPosition target = to;
    set_plane(c, target, way.end);
    if (way.arc) {
        const PlaneAxes& plane = plane_axes(c.modal);
        ProgramArc arc;
        arc.centre = xyz_of(c.program);
        arc.centre[static_cast<Eigen::Index>(index_of(plane.first))] = way.centre.x;
        arc.centre[static_cast<Eigen::Index>(index_of(plane.second))] = way.centre.y;
        arc.normal = Vector3::Unit(static_cast<Eigen::Index>(index_of(plane.normal)));
        arc.sweep_rad = way.sweep_rad;
        move_arc(c, way.sweep_rad < 0.0 ? MotionKind::arc_cw : MotionKind::arc_ccw, target, arc);
    } else {
        move_line(c, move.rapid ? MotionKind::rapid : MotionKind::linear, target);
    }
    c.path.tool = c.program;
    c.program = programmed;
    c.feed = feed;
}

}  // namespace trunnion

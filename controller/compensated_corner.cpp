#include "controller/compensated_corner.h"

#include <cmath>

#include "controller/arcs.h"
#include "controller/control_state.h"

namespace trunnion {

namespace {

/// An arc smaller than the cutter has no path beside it.
void check_radius(const PathMove& m) {
    if (!m.plane.arc) return;
    const double radius = offset_radius(m.plane, m.offset_mm);
    if (std::abs(radius) <= 1e-6) raise_alarm(38);
    if (radius < 0.0) raise_alarm(41);
}

/// The tool must not run backwards along the side: the cutter does not fit.
void check_direction(const PathMove& m, const PlaneElement& way) {
    constexpr double slack_mm = 1e-6;
    if (!m.plane.arc) {
        if (dot(way.end - way.start, tangent_at_start(m.plane)) < -slack_mm) raise_alarm(41);
        return;
    }
    check_radius(m);
    if (way.sweep_rad * m.plane.sweep_rad < 0.0) raise_alarm(41);
}

struct Corner {
    bool inside = false;
    bool acute = false;  ///< outside, the path turns by more than 90 degrees
    bool straight = false;
    PlanePoint t1, t2;
    double offset = 0.0;
};

Corner corner_of(const PathMove& first, const PathMove& second) {
    Corner out;
    out.t1 = tangent_at_end(first.plane);
    out.t2 = tangent_at_start(second.plane);
    const double turn = cross(out.t1, out.t2), along = dot(out.t1, out.t2);
    out.offset = first.offset_mm != 0.0 ? first.offset_mm : second.offset_mm;
    out.straight = std::abs(turn) < 1e-7 && along > 0.0;
    out.inside = turn * out.offset > 0.0 && !(std::abs(turn) < 1e-7);
    out.acute = !out.inside && along < 0.0;
    return out;
}

/// Inside corner: both offset paths end where they meet.
void inside_corner(ControlState& c, const PathMove& first, const PathMove& second) {
    check_radius(first);
    check_radius(second);
    const auto meeting = offset_meeting(first.plane, first.offset_mm, second.plane,
                                        second.offset_mm, first.plane.end);
    if (!meeting) raise_alarm(33);
    run_beside(c, first, *meeting);
}

/// Outside corner: straight pieces round the corner point; an arc ends square to its end first.
void outside_corner(ControlState& c, const PathMove& first, const PathMove& second,
                    const Corner& corner) {
    const PlanePoint p = first.plane.end;
    const PlanePoint n1 = left_of(corner.t1), n2 = left_of(corner.t2);
    const double o = corner.offset, r = std::abs(o);
    const PlanePoint end1 = p + o * n1, start2 = p + o * n2;
    const PlanePoint beyond =
        corner.acute ? end1 + r * corner.t1 : p + (o / (1.0 + dot(n1, n2))) * (n1 + n2);
    run_beside(c, first, first.plane.arc ? end1 : beyond);
    if (first.plane.arc) line_to(c, first, beyond);
    if (corner.acute) line_to(c, first, start2 - r * corner.t2);
    if (second.plane.arc) line_to(c, first, start2);
}

/// An arc of the cutter's radius round the end of `first`, to the point square to `direction`.
void corner_arc(ControlState& c, const PathMove& first, PlanePoint direction) {
    const double o = first.offset_mm;
    run_beside(c, first, square_to_end(first));
    PlaneElement arc;
    arc.arc = true;
    arc.centre = first.plane.end;
    arc.start = tool_in_plane(c);
    arc.end = arc.centre + (o / length_of(direction)) * left_of(direction);
    arc.sweep_rad = sweep_of(arc.centre, arc.start, arc.end, o > 0.0);
    if (length_of(arc.end - arc.start) < 1e-6) return;
    send_path(c, first, arc, first.to, true);
}

/// Start-up: type A goes to the point square to the start of the second move; type B as if it had
/// been compensated before, outside corners only.
void start_up(ControlState& c, const PathMove& first, const PathMove& second) {
    const Corner corner = corner_of(first, second);
    if (!c.settings.startup_type_b || corner.inside || corner.straight)
        return run_beside(c, first, square_to_start(second));
    outside_corner(c, first, second, corner);
}

/// Cancel: the mirror image of start-up.
void cancel(ControlState& c, const PathMove& first, const PathMove& second) {
    const Corner corner = corner_of(first, second);
    if (!c.settings.startup_type_b || corner.inside || corner.straight || second.plane.arc)
        return run_beside(c, first, square_to_end(first));
    outside_corner(c, first, second, corner);
}

void round_corner(ControlState& c, const PathMove& first, const PathMove& second,
                  const Corner& corner) {
    if (corner.straight) return run_beside(c, first, square_to_end(first));
    if (corner.inside) return inside_corner(c, first, second);
    if (c.settings.circular_corners) return corner_arc(c, first, corner.t2);
    outside_corner(c, first, second, corner);
}

}  // namespace

PlanePoint square_to_end(const PathMove& m) {
    return m.plane.end + m.offset_mm * left_of(tangent_at_end(m.plane));
}
PlanePoint square_to_start(const PathMove& m) {
    return m.plane.start + m.offset_mm * left_of(tangent_at_start(m.plane));
}

PlanePoint tool_in_plane(const ControlState& c) {
    const PlaneAxes& plane = plane_axes(c.modal);
    return {c.path.tool[plane.first], c.path.tool[plane.second]};
}

void line_to(ControlState& c, const PathMove& m, PlanePoint end) {
    PlaneElement way;
    way.start = tool_in_plane(c);
    way.end = end;
    send_path(c, m, way, m.to, m.offset_mm != 0.0 && c.path.last_offset_mm != 0.0);
}

void run_beside(ControlState& c, const PathMove& m, PlanePoint end) {
    const double before = c.path.last_offset_mm;
    const bool free = before == 0.0 && m.offset_mm == 0.0;  // a corner alone
    const bool starts = !free && before == 0.0, ends = !free && m.offset_mm == 0.0;
    if (m.plane.arc && (starts || ends)) raise_alarm(34);
    PlaneElement way;
    if (m.plane.arc) {
        way = between(m.plane, tool_in_plane(c), end);
    } else {
        way.start = tool_in_plane(c);
        way.end = end;
    }
    if (!starts && !ends) check_direction(m, way);
    send_path(c, m, way, m.to, !free && !starts && !ends);
}

void finish_first(ControlState& c, const PathMove& first, const PathMove& second) {
    const double before = c.path.last_offset_mm;
    if (first.offset_mm == 0.0) return run_beside(c, first, first.plane.end);
    if (first.corner_arc) {
        const bool own = length_of(first.corner_arc_to) > 0.0;
        return corner_arc(c, first, own ? first.corner_arc_to : tangent_at_start(second.plane));
    }
    if (second.offset_mm == 0.0)
        return before == 0.0 ? run_beside(c, first, square_to_end(first))
                             : cancel(c, first, second);
    if (before == 0.0) return start_up(c, first, second);
    if (first.offset_mm != second.offset_mm) {  // other side or other D
        run_beside(c, first, square_to_end(first));
        return line_to(c, first, square_to_start(second));
    }
    round_corner(c, first, second, corner_of(first, second));
}

}  // namespace trunnion

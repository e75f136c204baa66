#include "cutter/compensated_corner.h"

#include <cmath>

#include "cutter/cutter_alarms.h"

namespace trunnion::cutter {

namespace {

struct Corner {
    bool inside = false;
    bool acute = false;  ///< outside corner where the path turns by more than 90 degrees
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

/// Inside corner: both offset paths end at their intersection.
void inside_corner(BesidePath& path, const PathMove& first, const PathMove& second) {
    check_radius(first);
    check_radius(second);
    const auto meeting = offset_meeting(first.plane, first.offset_mm, second.plane,
                                        second.offset_mm, first.plane.end);
    if (!meeting) raise_cutter_alarm(33);
    path.run_beside(first, *meeting);
}

/// Outside corner: straight segments round the corner point. After an arc the first one starts
/// perpendicular to its end.
void outside_corner(BesidePath& path, const PathMove& first, const PathMove& second,
                    const Corner& corner) {
    const PlanePoint p = first.plane.end;
    const PlanePoint n1 = left_of(corner.t1), n2 = left_of(corner.t2);
    const double o = corner.offset, r = std::abs(o);
    const PlanePoint end1 = p + o * n1, start2 = p + o * n2;
    const PlanePoint beyond =
        corner.acute ? end1 + r * corner.t1 : p + (o / (1.0 + dot(n1, n2))) * (n1 + n2);
    path.run_beside(first, first.plane.arc ? end1 : beyond);
    if (first.plane.arc) path.line_to(first, beyond);
    if (corner.acute) path.line_to(first, start2 - r * corner.t2);
    if (second.plane.arc) path.line_to(first, start2);
}

/// An arc of cutter radius round the end of `first`, up to the point perpendicular to `direction`.
void corner_arc(BesidePath& path, const PathMove& first, PlanePoint direction) {
    const double o = first.offset_mm;
    path.run_beside(first, square_to_end(first));
    PlaneElement arc;
    arc.arc = true;
    arc.centre = first.plane.end;
    arc.start = path.tool_in_plane(first);
    arc.end = arc.centre + (o / length_of(direction)) * left_of(direction);
    arc.sweep_rad = sweep_of(arc.centre, arc.start, arc.end, o > 0.0);
    if (length_of(arc.end - arc.start) < 1e-6) return;
    path.send(first, arc, true);
}

/// Start-up. Type A moves to the point perpendicular to the start of the second move. Type B moves
/// as if compensation had been active before; it differs from A at outside corners only.
void start_up(BesidePath& path, const PathMove& first, const PathMove& second) {
    const Corner corner = corner_of(first, second);
    if (!path.settings.startup_type_b || corner.inside || corner.straight)
        return path.run_beside(first, square_to_start(second));
    outside_corner(path, first, second, corner);
}

/// Cancel: the mirror image of start-up.
void cancel(BesidePath& path, const PathMove& first, const PathMove& second) {
    const Corner corner = corner_of(first, second);
    if (!path.settings.startup_type_b || corner.inside || corner.straight || second.plane.arc)
        return path.run_beside(first, square_to_end(first));
    outside_corner(path, first, second, corner);
}

void round_corner(BesidePath& path, const PathMove& first, const PathMove& second,
                  const Corner& corner) {
    if (corner.straight) return path.run_beside(first, square_to_end(first));
    if (corner.inside) return inside_corner(path, first, second);
    if (path.settings.circular_corners) return corner_arc(path, first, corner.t2);
    outside_corner(path, first, second, corner);
}

}  // namespace

void finish_first(BesidePath& path, const PathMove& first, const PathMove& second) {
    const double before = path.last_offset_mm;
    if (first.offset_mm == 0.0) return path.run_beside(first, first.plane.end);
    if (first.corner_arc) {
        const bool own = length_of(first.corner_arc_to) > 0.0;
        return corner_arc(path, first, own ? first.corner_arc_to : tangent_at_start(second.plane));
    }
    if (second.offset_mm == 0.0)
        return before == 0.0 ? path.run_beside(first, square_to_end(first))
                             : cancel(path, first, second);
    if (before == 0.0) return start_up(path, first, second);
    if (first.offset_mm != second.offset_mm) {  // different side or different D
        path.run_beside(first, square_to_end(first));
        return path.line_to(first, square_to_start(second));
    }
    round_corner(path, first, second, corner_of(first, second));
}

}  // namespace trunnion::cutter

#include "cutter/corner_piece.h"

#include <cmath>

#include "cutter/cutter_alarms.h"
#include "geometry/plane_crossing.h"

namespace trunnion::cutter {

namespace {

/// Point on the element at distance `way` (mm along the element) before its end, or after its
/// start.
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

/// Point of the element nearest to `p`.
PlanePoint foot_on(const PlaneElement& e, PlanePoint p) {
    if (!e.arc) {
        const PlanePoint t = tangent_at_start(e);
        return e.start + dot(p - e.start, t) * t;
    }
    const PlanePoint r = p - e.centre;
    return e.centre + (e.radius() / length_of(r)) * r;
}

PlaneElement chamfer(const PathMove& first, const PathMove& second) {
    PlaneElement piece;
    piece.start = before_end(first.plane, first.corner_mm);
    piece.end = after_start(second.plane, first.corner_mm);
    return piece;
}

/// An arc tangent to both sides.
PlaneElement rounding(const PathMove& first, const PathMove& second) {
    PlaneElement piece;
    const PlaneElement &a = first.plane, &b = second.plane;
    const double turn = cross(tangent_at_end(a), tangent_at_start(b));
    const double side = turn < 0.0 ? -first.corner_mm : first.corner_mm;
    const auto centre = offset_meeting(a, side, b, side, a.end);
    if (!centre) raise_cutter_alarm(55);
    piece.arc = true;
    piece.centre = *centre;
    piece.start = foot_on(a, *centre);
    piece.end = foot_on(b, *centre);
    piece.sweep_rad = sweep_of(piece.centre, piece.start, piece.end, turn < 0.0);
    return piece;
}

void end_at(PathMove& m, PlanePoint point) {
    m.to[m.axes.first] = point.x;
    m.to[m.axes.second] = point.y;
}

}  // namespace

std::optional<PathMove> take_corner(PathMove& first, PathMove& second) {
    if (second.rapid) raise_cutter_alarm(52);
    const bool chamfers = first.chamfer;
    first.chamfer = first.round = false;
    const double turn = cross(tangent_at_end(first.plane), tangent_at_start(second.plane));
    if (std::abs(turn) <= 1e-9) return std::nullopt;
    PathMove corner = first;
    corner.plane = chamfers ? chamfer(first, second) : rounding(first, second);
    if (!within(first.plane, corner.plane.start, 1e-6) ||
        !within(second.plane, corner.plane.end, 1e-6))
        raise_cutter_alarm(55);
    first.plane = between(first.plane, first.plane.start, corner.plane.start);
    end_at(first, corner.plane.start);
    end_at(corner, corner.plane.end);
    second.plane = between(second.plane, corner.plane.end, second.plane.end);
    return corner;
}

}  // namespace trunnion::cutter

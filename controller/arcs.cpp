#include "controller/arcs.h"

#include <cmath>

#include "controller/wrapped_motion.h"

namespace trunnion {

namespace {

/// R commands whose chord is longer by no more than this are half circles when 3410 is 0 (assumed:
/// two least increments).
constexpr double chord_slack_mm = 0.002;

PlanePoint point_in(const ControlPosition& p, const PlaneAxes& plane) {
    return {p[plane.first], p[plane.second]};
}

Vector3 unit_vector(Axis axis) {
    return Vector3::Unit(static_cast<Eigen::Index>(index_of(axis)));
}

}  // namespace

void check_radii(PlanePoint centre, PlanePoint start, PlanePoint end, double tolerance_mm) {
    if (tolerance_mm <= 0.0) return;
    const double r0 = std::hypot(start.x - centre.x, start.y - centre.y);
    const double r1 = std::hypot(end.x - centre.x, end.y - centre.y);
    if (std::abs(r1 - r0) > tolerance_mm) raise_alarm(20);
}

PlanePoint centre_from_radius(PlanePoint start, PlanePoint end, double radius, bool clockwise,
                              double tolerance_mm) {
    const double dx = end.x - start.x, dy = end.y - start.y;
    const double chord = std::sqrt(dx * dx + dy * dy);
    const double half = 0.5 * chord, r = std::abs(radius);
    if (half - r > (tolerance_mm > 0.0 ? tolerance_mm : chord_slack_mm)) raise_alarm(20);
    const double rise = half < r ? std::sqrt((r - half) * (r + half)) : 0.0;
    // Counter-clockwise with less than half a turn has its centre left of the chord.
    const double side = (clockwise ? -1.0 : 1.0) * (radius < 0.0 ? -1.0 : 1.0) * rise / chord;
    return {start.x + 0.5 * dx - side * dy, start.y + 0.5 * dy + side * dx};
}

double sweep_of(PlanePoint centre, PlanePoint start, PlanePoint end, bool clockwise) {
    const double x0 = start.x - centre.x, y0 = start.y - centre.y;
    const double x1 = end.x - centre.x, y1 = end.y - centre.y;
    double angle = std::atan2(x0 * y1 - y0 * x1, x0 * x1 + y0 * y1);
    constexpr double same = 1e-9;  // rad: rounding of a full circle's end point
    if (clockwise) return angle >= -same ? angle - 2.0 * pi : angle;
    return angle <= same ? angle + 2.0 * pi : angle;
}

ArcInPlane arc_in_plane(ControlState& c, const ControlPosition& target, bool clockwise) {
    const SortedWords& w = c.words;
    const PlaneAxes& plane = plane_axes(c.modal);
    const PlanePoint start = point_in(c.program, plane), end = point_in(target, plane);
    ArcInPlane out{start, 0.0, false};
    if (w.has('R')) {  // R goes before I J K when both stand in a block
        const double radius = c.length_word('R');
        if (radius == 0.0) raise_alarm(22, w.column_of('R'));
        if (start.x == end.x && start.y == end.y) return out;  // an arc of 0 degrees: no move
        out.centre = centre_from_radius(start, end, radius, clockwise, c.settings.arc_tolerance_mm);
    } else {
        if (w.has(plane.centre_first)) out.centre.x += c.length_word(plane.centre_first);
        if (w.has(plane.centre_second)) out.centre.y += c.length_word(plane.centre_second);
        check_radii(out.centre, start, end, c.settings.arc_tolerance_mm);
    }
    out.sweep_rad = sweep_of(out.centre, start, end, clockwise);
    out.is_arc = true;
    return out;
}

/// A centre word of the wrong plane alone: G17 with K.
void check_plane_of_centre(const ControlState& c) {
    if (has_arc_words(c)) return;
    for (const char letter : {'I', 'J', 'K'})
        if (c.words.has(letter)) raise_alarm(21, c.words.column_of(letter));
}

bool has_arc_words(const ControlState& c) {
    const PlaneAxes& plane = plane_axes(c.modal);
    return c.words.has('R') || c.words.has(plane.centre_first) || c.words.has(plane.centre_second);
}

void move_arc_block(ControlState& c, bool clockwise) {
    if (c.cylinder) return move_cylinder_arc(c, clockwise);
    check_plane_of_centre(c);
    const PlaneAxes& plane = plane_axes(c.modal);
    const ControlPosition target = c.target();
    if (!has_arc_words(c)) {
        if (c.settings.arc_needs_centre) raise_alarm(22);
        move_line(c, MotionKind::linear, target);  // 3403#5 = 0: a straight line
        return;
    }
    const ArcInPlane found = arc_in_plane(c, target, clockwise);
    if (!found.is_arc) {
        move_line(c, MotionKind::linear, target);
        return;
    }
    ProgramArc arc;
    arc.centre = xyz_of(c.program);
    arc.centre[static_cast<Eigen::Index>(index_of(plane.first))] = found.centre.x;
    arc.centre[static_cast<Eigen::Index>(index_of(plane.second))] = found.centre.y;
    arc.normal = unit_vector(plane.normal);
    arc.sweep_rad = found.sweep_rad;
    move_arc(c, clockwise ? MotionKind::arc_cw : MotionKind::arc_ccw, target, arc);
}

}  // namespace trunnion

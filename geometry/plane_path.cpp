#include "geometry/plane_path.h"

#include <cmath>

#include "base/units.h"

namespace trunnion::inline geometry {

namespace {

constexpr double tiny = 1e-9;

double wrapped(double angle) {
    return std::remainder(angle, 2.0 * pi);
}
double direction(PlanePoint v) {
    return std::atan2(v.y, v.x);
}

/// The point on the line p + s t at distance r from `centre` that is nearer to `near`; empty when
/// the line does not reach the circle.
std::optional<PlanePoint> line_circle(PlanePoint p, PlanePoint t, PlanePoint centre, double r,
                                      PlanePoint near) {
    const double foot = dot(centre - p, t);
    const PlanePoint closest = p + foot * t;
    const double off = length_of(closest - centre);
    if (off > r + tiny) return std::nullopt;
    const double half = off < r ? std::sqrt((r - off) * (r + off)) : 0.0;
    const PlanePoint a = closest + half * t, b = closest - half * t;
    return length_of(a - near) <= length_of(b - near) ? a : b;
}

std::optional<PlanePoint> circle_circle(PlanePoint c1, double r1, PlanePoint c2, double r2,
                                        PlanePoint near) {
    const PlanePoint d = c2 - c1;
    const double distance = length_of(d);
    if (distance < tiny || distance > r1 + r2 + tiny || distance < std::abs(r1 - r2) - tiny)
        return std::nullopt;
    const double along = (distance * distance + r1 * r1 - r2 * r2) / (2.0 * distance);
    const double square = r1 * r1 - along * along;
    const double off = square > 0.0 ? std::sqrt(square) : 0.0;
    const PlanePoint u = (1.0 / distance) * d, foot = c1 + along * u;
    const PlanePoint a = foot + off * left_of(u), b = foot - off * left_of(u);
    return length_of(a - near) <= length_of(b - near) ? a : b;
}

std::optional<PlanePoint> line_line(PlanePoint p1, PlanePoint t1, PlanePoint p2, PlanePoint t2) {
    const double turn = cross(t1, t2);
    if (std::abs(turn) < tiny) return std::nullopt;
    return p1 + (cross(p2 - p1, t2) / turn) * t1;
}

}  // namespace

double sweep_of(PlanePoint centre, PlanePoint start, PlanePoint end, bool clockwise) {
    const PlanePoint r0 = start - centre, r1 = end - centre;
    const double angle = std::atan2(cross(r0, r1), dot(r0, r1));
    constexpr double same = 1e-9;  // rad: rounding of the end point of a full circle
    if (clockwise) return angle >= -same ? angle - 2.0 * pi : angle;
    return angle <= same ? angle + 2.0 * pi : angle;
}

bool PlaneElement::moves() const {
    return arc || length_of(end - start) > tiny;
}
double PlaneElement::radius() const {
    return length_of(start - centre);
}

PlanePoint tangent_at_start(const PlaneElement& e) {
    if (!e.arc) return (1.0 / length_of(e.end - e.start)) * (e.end - e.start);
    const PlanePoint r = e.start - e.centre;
    return (std::copysign(1.0, e.sweep_rad) / length_of(r)) * left_of(r);
}

PlanePoint tangent_at_end(const PlaneElement& e) {
    if (!e.arc) return tangent_at_start(e);
    const PlanePoint r = e.end - e.centre;
    return (std::copysign(1.0, e.sweep_rad) / length_of(r)) * left_of(r);
}

double offset_radius(const PlaneElement& e, double offset) {
    return e.radius() - (e.sweep_rad > 0.0 ? offset : -offset);
}

std::optional<PlanePoint> offset_meeting(const PlaneElement& first, double first_offset,
                                         const PlaneElement& second, double second_offset,
                                         PlanePoint corner) {
    const PlanePoint t1 = tangent_at_end(first), t2 = tangent_at_start(second);
    const PlanePoint p1 = corner + first_offset * left_of(t1);
    const PlanePoint p2 = corner + second_offset * left_of(t2);
    if (!first.arc && !second.arc) return line_line(p1, t1, p2, t2);
    if (!first.arc)
        return line_circle(p1, t1, second.centre, offset_radius(second, second_offset), p2);
    if (!second.arc)
        return line_circle(p2, t2, first.centre, offset_radius(first, first_offset), p1);
    return circle_circle(first.centre, offset_radius(first, first_offset), second.centre,
                         offset_radius(second, second_offset), p1);
}

PlaneElement between(const PlaneElement& e, PlanePoint start, PlanePoint end) {
    PlaneElement out = e;
    out.start = start;
    out.end = end;
    if (e.arc)
        out.sweep_rad += wrapped(direction(end - e.centre) - direction(e.end - e.centre)) -
                         wrapped(direction(start - e.centre) - direction(e.start - e.centre));
    return out;
}

}  // namespace trunnion::inline geometry

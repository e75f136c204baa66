#include "geometry/plane_crossing.h"

#include <array>
#include <cmath>

#include "base/units.h"

namespace trunnion::inline geometry {

namespace {

constexpr double slack_mm = 1e-6;
/// A half chord below this counts as tangency: the line then enters the circle by less than 1e-6 mm
/// for every radius above 0.5 mm.
constexpr double tangent_mm = 1e-3;

struct Points {
    std::array<PlanePoint, 2> point;
    std::size_t count = 0;
};

Points line_line(const PlaneElement& a, const PlaneElement& b) {
    const PlanePoint ta = tangent_at_start(a), tb = tangent_at_start(b);
    const double turn = cross(ta, tb);
    if (std::abs(turn) < 1e-9) return {};
    return {{a.start + (cross(b.start - a.start, tb) / turn) * ta}, 1};
}

Points both_sides(PlanePoint foot, double half, PlanePoint direction) {
    return {{foot + half * direction, foot - half * direction}, 2};
}

Points line_circle(const PlaneElement& line, const PlaneElement& arc) {
    const PlanePoint t = tangent_at_start(line);
    const PlanePoint foot = line.start + dot(arc.centre - line.start, t) * t;
    const double r = arc.radius(), off = length_of(foot - arc.centre);
    if (off >= r) return {};
    const double half = std::sqrt((r - off) * (r + off));
    return half < tangent_mm ? Points{} : both_sides(foot, half, t);
}

Points circle_circle(const PlaneElement& a, const PlaneElement& b) {
    const PlanePoint d = b.centre - a.centre;
    const double distance = length_of(d), r1 = a.radius(), r2 = b.radius();
    if (distance < slack_mm || distance >= r1 + r2 || distance <= std::abs(r1 - r2)) return {};
    const double along = (distance * distance + r1 * r1 - r2 * r2) / (2.0 * distance);
    const double square = r1 * r1 - along * along;
    if (square < tangent_mm * tangent_mm) return {};
    const PlanePoint u = (1.0 / distance) * d;
    return both_sides(a.centre + along * u, std::sqrt(square), left_of(u));
}

Points meetings(const PlaneElement& a, const PlaneElement& b) {
    if (!a.moves() || !b.moves()) return {};
    if (!a.arc && !b.arc) return line_line(a, b);
    if (!a.arc) return line_circle(a, b);
    if (!b.arc) return line_circle(b, a);
    return circle_circle(a, b);
}

bool same(PlanePoint a, PlanePoint b) {
    return length_of(a - b) < slack_mm;
}

bool holds(const PlaneElement& e, PlanePoint p) {
    if (!e.moves()) return same(e.start, p);
    const double off =
        e.arc ? length_of(p - e.centre) - e.radius() : cross(tangent_at_start(e), p - e.start);
    return std::abs(off) < slack_mm && within(e, p, slack_mm);
}

}  // namespace

bool within(const PlaneElement& e, PlanePoint p, double slack) {
    if (!e.arc) {
        const double s = dot(p - e.start, tangent_at_start(e));
        return s > -slack && s < length_of(e.end - e.start) + slack;
    }
    const PlanePoint u = e.start - e.centre, v = p - e.centre;
    const double side = e.sweep_rad < 0.0 ? -1.0 : 1.0;
    double angle = std::atan2(side * cross(u, v), dot(u, v));
    const double ends = slack / e.radius();
    if (angle < -ends) angle += 2.0 * pi;
    return angle < std::abs(e.sweep_rad) + ends;
}

bool touch(const PlaneElement& a, const PlaneElement& b) {
    if (holds(a, b.start) || holds(a, b.end) || holds(b, a.start) || holds(b, a.end)) return true;
    const Points found = meetings(a, b);
    for (std::size_t i = 0; i < found.count; ++i)
        if (within(a, found.point[i], slack_mm) && within(b, found.point[i], slack_mm)) return true;
    return false;
}

bool cross_over(const PlaneElement& a, const PlaneElement& b) {
    const Points found = meetings(a, b);
    for (std::size_t i = 0; i < found.count; ++i) {
        const PlanePoint p = found.point[i];
        if (same(p, a.end) && same(p, b.start)) continue;
        if (within(a, p, slack_mm) && within(b, p, slack_mm)) return true;
    }
    return false;
}

}  // namespace trunnion::inline geometry

#include "motion/motion.h"

#include <cmath>

#include "base/units.h"

namespace trunnion::motion {

Vector3 point_on_arc(const ArcPath& arc, const Vector3& from, const Vector3& to, double s) {
    const auto split = [&](const Vector3& p) {
        const Vector3 r = p - arc.centre_mm;
        const double height = r.dot(arc.normal);
        return std::pair<Vector3, double>{r - height * arc.normal, height};
    };
    const auto [start, height_start] = split(from);
    const auto [end, height_end] = split(to);
    const double r0 = start.norm(), r1 = end.norm();
    if (r0 == 0.0) return from + s * (to - from);
    const double radius = r0 + s * (r1 - r0), angle = s * arc.sweep_rad;
    const Vector3 u = start / r0, v = arc.normal.cross(u);
    return arc.centre_mm + radius * (std::cos(angle) * u + std::sin(angle) * v) +
           (height_start + s * (height_end - height_start)) * arc.normal;
}

double arc_length_mm(const ArcPath& arc, const Vector3& from, const Vector3& to) {
    const Vector3 radius_vector = from - arc.centre_mm;
    const double rise = arc.normal.dot(to - from);
    const double radius = (radius_vector - radius_vector.dot(arc.normal) * arc.normal).norm();
    const double bow = radius * arc.sweep_rad;
    return std::sqrt(bow * bow + rise * rise);
}

double turns_of(double sweep_rad) {
    const double begun = std::ceil(std::abs(sweep_rad) / (2.0 * pi) - 1e-9);
    return std::copysign(std::fmax(1.0, begun), sweep_rad);
}

AxisPositions AxisMove::at(double s) const {
    if (s <= 0.0) return from;
    if (s >= 1.0) return to;
    if (curve) return curve->at(s);
    AxisPositions out;
    for (std::size_t i = 0; i < axis_count; ++i)
        out.value[i] = from.value[i] + s * (to.value[i] - from.value[i]);
    if (arc) {
        const Vector3 p = point_on_arc(*arc, {from.value[0], from.value[1], from.value[2]},
                                       {to.value[0], to.value[1], to.value[2]}, s);
        for (std::size_t i = 0; i < 3; ++i) out.value[i] = p[static_cast<Eigen::Index>(i)];
    }
    return out;
}

}  // namespace trunnion::motion

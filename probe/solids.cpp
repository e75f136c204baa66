#include "probe/solids.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "probe/closing_gap.h"

namespace trunnion::probe {

namespace {

/// Combines the signed distances to each pair of faces into one signed distance.
template <int n>
double outside_or_inside(const Eigen::Matrix<double, n, 1>& beyond) {
    const double outside = beyond.cwiseMax(0.0).norm();
    return outside > 0.0 ? outside : beyond.maxCoeff();
}

}  // namespace

double distance_mm(const Solid& solid, const Vector3& p) {
    if (!solid.round) return outside_or_inside<3>((solid.low - p).cwiseMax(p - solid.high));
    const double radius = std::hypot(p.x(), p.y());
    const double across = solid.inner_mm > 0.0
                              ? std::max(solid.inner_mm - radius, radius - solid.outer_mm)
                              : radius - solid.outer_mm;
    return outside_or_inside<2>({across, std::max(solid.low.z() - p.z(), p.z() - solid.high.z())});
}

double distance_mm(std::span<const Solid> solids, const Vector3& point_mm) {
    double least = std::numeric_limits<double>::infinity();
    for (const Solid& solid : solids) least = std::min(least, distance_mm(solid, point_mm));
    return least;
}

std::optional<double> first_contact(std::span<const Solid> solids, const BallPath& ball,
                                    double radius_mm) {
    return first_closing(
        ball, [&](const Vector3& centre) { return distance_mm(solids, centre) - radius_mm; });
}

}  // namespace trunnion::probe

#include "probe/solids.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trunnion::probe {

namespace {

constexpr double root_mm = 1e-10;
constexpr double shortest_step_mm = 2e-4;

/// Distances beyond each pair of faces, to one number.
template <int n>
double outside_or_inside(const Eigen::Matrix<double, n, 1>& beyond) {
    const double outside = beyond.cwiseMax(0.0).norm();
    return outside > 0.0 ? outside : beyond.maxCoeff();
}

/// Largest speed of the ball in mm per s, with a reserve for what lies between the samples.
double speed_bound(const BallPath& ball) {
    constexpr int samples = 32;
    double most = 0.0;
    Vector3 last = ball(0.0);
    for (int i = 1; i <= samples; ++i) {
        const Vector3 next = ball(static_cast<double>(i) / samples);
        most = std::max(most, (next - last).norm() * samples);
        last = next;
    }
    return 1.5 * most;
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
    const auto gap = [&](double s) { return distance_mm(solids, ball(s)) - radius_mm; };
    double s = 0.0, g = gap(s);
    if (g <= 0.0) return 0.0;
    const double speed_mm = speed_bound(ball);
    if (speed_mm == 0.0) return std::nullopt;
    while (s < 1.0) {  // the gap cannot close faster than the ball moves
        const double next = std::min(1.0, s + std::max(g, shortest_step_mm) / speed_mm);
        g = gap(next);
        if (g > 0.0) {
            s = next;
            continue;
        }
        double before = s, after = next;
        while ((after - before) * speed_mm > root_mm) {
            const double middle = 0.5 * (before + after);
            (gap(middle) > 0.0 ? before : after) = middle;
        }
        return after;
    }
    return std::nullopt;
}

}  // namespace trunnion::probe

#include "probe/touch_probe.h"

#include <algorithm>
#include <cmath>

namespace trunnion::probe {
namespace {

constexpr double root_mm = 1e-10;          ///< well below the 1e-9 mm that is promised
constexpr double shortest_step_mm = 2e-4;  ///< a grazing touch hidden in one is below 1e-6 mm deep

/// Largest speed |d separation / ds| in mm, with a reserve for what lies between the samples.
double speed_bound(const Separation& separation) {
    constexpr int samples = 32;
    double most = 0.0;
    Vector3 last = separation(0.0);
    for (int i = 1; i <= samples; ++i) {
        const Vector3 next = separation(static_cast<double>(i) / samples);
        most = std::max(most, (next - last).norm() * samples);
        last = next;
    }
    return 1.5 * most;
}

/// Root of a falling function between a (positive) and b (not positive): Illinois steps.
template <class Gap>
double root(const Gap& gap, double a, double gap_a, double b, double gap_b, double width) {
    int side = 0;
    for (int i = 0; i < 200 && b - a > width; ++i) {
        double s = (a * gap_b - b * gap_a) / (gap_b - gap_a);
        if (!(s > a && s < b)) s = 0.5 * (a + b);
        const double g = gap(s);
        if (std::abs(g) < root_mm / 10) return s;
        if (g > 0.0) {
            a = s, gap_a = g;
            if (side == 1) gap_b *= 0.5;
            side = 1;
        } else {
            b = s, gap_b = g;
            if (side == -1) gap_a *= 0.5;
            side = -1;
        }
    }
    return b;
}

}  // namespace

Vector3 centre_to_tip_M(const kinematics::MachinePose& poses, const TouchProbe& probe,
                        const SphereTarget& sphere) {
    return poses.pose_MS * probe.tip_S_mm - poses.pose_MW * sphere.center_W_mm;
}

WayToSphere way_to_sphere(const Vector3& separation, const Vector3& direction, double reach_mm) {
    const double along = separation.dot(direction);
    const double inside = along * along - separation.squaredNorm() + reach_mm * reach_mm;
    return {-along - std::sqrt(std::max(0.0, inside)), inside >= 0.0};
}

std::optional<double> first_contact(const Separation& separation, double reach_mm) {
    const auto gap = [&](double s) { return separation(s).norm() - reach_mm; };
    double s = 0.0, g = gap(s);
    if (g <= 0.0) return 0.0;
    const double speed_mm = speed_bound(separation);
    if (speed_mm == 0.0) return std::nullopt;
    while (s < 1.0) {  // the gap cannot close faster than the ball moves
        const double next = std::min(1.0, s + std::max(g, shortest_step_mm) / speed_mm);
        const double g_next = gap(next);
        if (g_next <= 0.0) return root(gap, s, g, next, g_next, root_mm / speed_mm);
        s = next, g = g_next;
    }
    return std::nullopt;
}

}  // namespace trunnion::probe

#include "probe/touch_probe.h"

#include <algorithm>
#include <cmath>

#include "probe/closing_gap.h"

namespace trunnion::probe {

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
    return first_closing(separation, [&](const Vector3& v) { return v.norm() - reach_mm; });
}

}  // namespace trunnion::probe

#include "setup/body.h"

#include "base/units.h"

namespace trunnion::setup {

Pose Body::pose_WB() const {
    const auto turn = [&](Eigen::Index k) {
        return rotation_about(Vector3::Unit(k), rad_from_deg(tilt_deg[k]));
    };
    return {turn(2) * turn(1) * turn(0), center_W_mm};
}

}  // namespace trunnion::setup

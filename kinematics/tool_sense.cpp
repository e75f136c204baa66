#include "kinematics/tool_sense.h"

namespace trunnion::kinematics {

Vector3 tool_senses(const Chain& chain) {
    Vector3 senses = Vector3::Ones();
    const auto take = [&](const std::vector<AxisGeometry>& axes, double side) {
        for (const AxisGeometry& axis : axes) {
            const auto k = static_cast<Eigen::Index>(index_of(axis.axis));
            if (axis.rotary || k > 2) continue;
            if (side * axis.direction(k) < 0.0) senses(k) = -1.0;
        }
    };
    take(chain.tool, 1.0);
    take(chain.work, -1.0);
    return senses;
}

}  // namespace trunnion::kinematics

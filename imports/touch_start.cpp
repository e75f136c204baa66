#include "imports/touch_start.h"

namespace trunnion::imports {

bool advances(const TouchStart& before, const TouchStart& now, double tolerance_mm) {
    if (before.test != now.test || before.mode != now.mode) return true;
    Vector3 apart_mm = now.at_mm - before.at_mm;
    for (const Axis axis : all_axes) {
        const double step = now.stands[axis] - before.stands[axis];
        if (is_rotary(axis) && step != 0.0) return true;
        if (index_of(axis) < 3) apart_mm(static_cast<Eigen::Index>(index_of(axis))) -= step;
    }
    return apart_mm.norm() <= tolerance_mm;
}

}  // namespace trunnion::imports

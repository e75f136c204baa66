// The touches behind one measured sphere centre, and the influence of form deviations on it.
#pragma once

#include <functional>
#include <vector>

#include "geometry/pose.h"

namespace trunnion::effects {

/// Outward normals (in M) of the touches of one sphere: the pole, then rings of four from the
/// equator upwards. Centre and radius are fitted by least squares, as in sphere cycles.
struct TouchPattern {
    std::vector<Vector3> outward_M;
    Eigen::Matrix<double, 3, Eigen::Dynamic> response;  ///< centre shift, mm per mm of each radial
                                                        ///< deviation

    Vector3 center_shift(const std::function<double(const Vector3& outward_M)>& deviation_mm) const;
};

/// The pattern of `touches` touches (at least 5); the reference stays valid.
const TouchPattern& touch_pattern(int touches);

}  // namespace trunnion::effects

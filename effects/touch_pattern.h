// The touches behind one found sphere centre, and what a form deviation does to that centre.
#pragma once

#include <functional>
#include <vector>

#include "geometry/pose.h"

namespace trunnion::effects {

/// Outward normals (in M) of the touches of one sphere: the pole, then rings of four from the
/// equator up. Centre and radius are fitted by least squares, as sphere cycles do.
struct TouchPattern {
    std::vector<Vector3> outward_M;
    Eigen::Matrix<double, 3, Eigen::Dynamic> response;  ///< centre shift for each radial deviation

    Vector3 center_shift(const std::function<double(const Vector3& outward_M)>& deviation_mm) const;
};

/// The pattern of `touches` touches (at least 5); kept for the life of the program.
const TouchPattern& touch_pattern(int touches);

}  // namespace trunnion::effects

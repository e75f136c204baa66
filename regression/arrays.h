// A vector as plain numbers, as stored in reports.
#pragma once

#include <array>

#include "geometry/pose.h"

namespace trunnion::regression {

inline std::array<double, 3> array_of(const Vector3& v) {
    return {v.x(), v.y(), v.z()};
}

}  // namespace trunnion::regression

// The planes G17, G18 and G19.
#pragma once

#include "geometry/axes.h"

namespace trunnion::motion {

/// The two axes of a plane and its normal, in right-handed order.
struct PlaneAxes {
    Axis first = Axis::X, second = Axis::Y, normal = Axis::Z;
    char centre_first = 'I', centre_second = 'J';  ///< I J, K I, J K
};
constexpr PlaneAxes plane_xy{};
constexpr PlaneAxes plane_zx{Axis::Z, Axis::X, Axis::Y, 'K', 'I'};
constexpr PlaneAxes plane_yz{Axis::Y, Axis::Z, Axis::X, 'J', 'K'};

}  // namespace trunnion::motion

// What each axis can do, as the control knows it.
#pragma once

#include <array>

#include "geometry/axes.h"

namespace trunnion::motion {

/// By axis letter, in what the axes are driven with (mm, rad, s). Speeds and accelerations are kept
/// as their inverses: 0 means no limit, and letters without an axis have none.
struct AxisLimits {
    std::array<double, axis_count> min, max;          ///< stored stroke
    std::array<double, axis_count> seconds_per_unit;  ///< at the highest speed
    std::array<double, axis_count> per_acceleration;  ///< s^2 per unit
    std::array<double, axis_count> per_jump;          ///< s per unit: 1783 at corners
    bool accelerates = false;  ///< some axis has an acceleration: moves take ramps
};

}  // namespace trunnion::motion

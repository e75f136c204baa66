// Limits of the axes as the control knows them.
#pragma once

#include <array>

#include "geometry/axes.h"

namespace trunnion::motion {

/// By axis letter, in mm or rad, and s. Speeds and accelerations are stored as inverses, so 0 means
/// no limit. Letters without an axis have no limit.
struct AxisLimits {
    std::array<double, axis_count> min, max;          ///< stored stroke
    std::array<double, axis_count> seconds_per_unit;  ///< at maximum speed
    std::array<double, axis_count> per_acceleration;  ///< inverse acceleration, s^2 per unit
    std::array<double, axis_count> per_jump;          ///< s per unit: inverse speed change allowed
                                                      ///< at corners (1783)
    bool accelerates = false;  ///< at least one axis has an acceleration limit: moves are ramped
};

}  // namespace trunnion::motion

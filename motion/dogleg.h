// A rapid that is not interpolated: each axis runs at its own speed and waits for the slowest.
#pragma once

#include "motion/axis_limits.h"
#include "motion/motion.h"

namespace trunnion::motion {

/// s counts time: 1 is where the slowest axis arrives. Ramps are left out.
class Dogleg : public PathCurve {
  public:
    Dogleg(const AxisPositions& from, const AxisPositions& to, const AxisLimits& limits);
    AxisPositions at(double s) const override;
    /// All axes arrive together: the way is a straight line.
    bool is_straight() const;

  private:
    AxisPositions from_, to_;
    std::array<double, axis_count> pace_{};  ///< of an axis's own way: 1 / its part of the time
};

}  // namespace trunnion::motion

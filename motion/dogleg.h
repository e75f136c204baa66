// A rapid without interpolation: each axis runs at its own speed; the move ends with the slowest.
#pragma once

#include "motion/axis_limits.h"
#include "motion/motion.h"

namespace trunnion::motion {

/// s is time: s = 1 is the arrival of the slowest axis. Acceleration ramps are neglected.
class Dogleg : public PathCurve {
  public:
    Dogleg(const AxisPositions& from, const AxisPositions& to, const AxisLimits& limits);
    AxisPositions at(double s) const override;
    /// True when all axes arrive together, so the path is a straight line.
    bool is_straight() const;

  private:
    AxisPositions from_, to_;
    std::array<double, axis_count> pace_{};  ///< ratio of total duration to duration of the axis
};

}  // namespace trunnion::motion

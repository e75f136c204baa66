// Duration of moves: path rate by feed and axis limits, and the time added by acceleration.
#pragma once

#include "motion/axis_limits.h"
#include "motion/motion.h"
#include "motion/speed_chain.h"

namespace trunnion::motion {

/// Follows the moves that the control sends out. Positioning, G31, exact stops (G9, G61), dwells
/// and M codes start and end at rest. Cutting moves are blended (G64): at a corner each axis may
/// change its speed by the jump of parameter 1783 (F_c = F / R_max of the automatic corner
/// deceleration, B-63833EN-1 p. 354).
class Pace {
  public:
    /// Input: `move.duration_s` at the commanded rate. Output: `move.duration_s` is the time by
    /// which the run grows if it ends with this move. `way`: path length to which F refers, mm.
    /// Returns the duration (s) at the rate allowed by feed and axis speeds. Acceleration is
    /// included in `duration_s` only, not in the feed.
    double take(AxisMove& move, const AxisLimits& limits, double way);
    void stop() { chain_.stop(); }

  private:
    double corner_speed(const AxisPositions& begin, const AxisLimits& limits) const;

    SpeedChain chain_;
    AxisPositions end_rate_;  ///< axis units per mm of path at the end of the previous move
};

}  // namespace trunnion::motion

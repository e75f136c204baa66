// When a move is over: its rate by feed and axes, and what speeding up and slowing down add.
#pragma once

#include "motion/axis_limits.h"
#include "motion/motion.h"
#include "motion/speed_chain.h"

namespace trunnion::motion {

/// Runs along with the moves that go out. Positioning, G31, exact stops (G9, G61), dwells and M
/// codes begin and end at rest; cutting moves run into each other (G64) as fast as parameter 1783
/// lets each axis change its speed at once (F_c = F / R_max of the automatic corner deceleration,
/// B-63833EN-1 p. 354).
class Pace {
  public:
    /// `move.duration_s`: at the commanded rate; becomes the time by which the run grows when it
    /// ends with this move. `way`: what F divides, mm. Returns the time at the rate that feed and
    /// axis speeds allow: what accelerations cost is in the duration alone, not in the feed.
    double take(AxisMove& move, const AxisLimits& limits, double way);
    void stop() { chain_.stop(); }

  private:
    double corner_speed(const AxisPositions& begin, const AxisLimits& limits) const;

    SpeedChain chain_;
    AxisPositions end_rate_;  ///< of the move before, axis units a mm of way
};

}  // namespace trunnion::motion

// How long a move takes at constant rate: length / feed, no faster than the slowest axis; rapids by
// the slowest axis. What speeding up and slowing down add: controller/pace.h.
#pragma once

#include "controller/control_state.h"

namespace trunnion {

/// Time of a rapid from `from` to `to`: the axis that takes longest at its own rapid speed.
double rapid_time(const AxisLimits& limits, const AxisPositions& from, const AxisPositions& to);
/// Time of a cutting move of `length_mm` (degrees counted as mm, as the control does); throws
/// PS0011 without feed, PS1202 under G93 without F in the block.
double cutting_time(const ControlState& c, double length_mm, const AxisPositions& from,
                    const AxisPositions& to);
/// The length a control divides by F: all axes together, degrees as mm.
double feed_length(const ControlPosition& from, const ControlPosition& to);

}  // namespace trunnion

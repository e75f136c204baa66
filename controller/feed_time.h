// How long a move takes at constant rate: length / feed, no faster than the slowest axis; rapids by
// the slowest axis. What speeding up and slowing down add: motion/pace.h.
#pragma once

#include "controller/control_state.h"

namespace trunnion {

/// Time of a rapid from `from` to `to`: the axis that takes longest at its own rapid speed.
double rapid_time(const AxisLimits& limits, const AxisPositions& from, const AxisPositions& to);
/// Time of a cutting move of `length_mm` (what F divides); throws PS0011 without feed, PS1202 under
/// G93 without F in the block.
double cutting_time(const ControlState& c, double length_mm, const AxisPositions& from,
                    const AxisPositions& to);
/// What F divides on the way from where the axes stand, mm. A degree counts as one unit of the
/// feed, a millimetre or, under G20, an inch: F is degrees a minute for rotary axes in both (Fanuc
/// B-63172EN p. 51: their values know no inch; that F follows is assumed).
double feed_length(const ControlState& c, const ControlPosition& to);
/// Its square over the axes from the `first` letter on.
double feed_square(const ControlState& c, const ControlPosition& to, std::size_t first);

}  // namespace trunnion

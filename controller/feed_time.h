// How long a move takes at constant rate: length / feed, no faster than the slowest axis; rapids by
// the slowest axis. What speeding up and slowing down add: motion/pace.h.
#pragma once

#include "controller/modal.h"
#include "motion/axis_limits.h"
#include "offsets/control_position.h"

namespace trunnion::controller {

/// Limits of the axes from the configuration. Rapid speeds where the setup gives none (assumed):
/// 24 m/min and 90 deg/s.
motion::AxisLimits axis_limits(const std::vector<ControlAxis>& axes);
/// 1783 into the limits.
void set_corner_jumps(const ControlSettings& settings, motion::AxisLimits& limits);
/// Time (s) of a rapid from `from` to `to`: the axis that takes longest at its own rapid speed.
double rapid_time(const motion::AxisLimits& limits, const AxisPositions& from,
                  const AxisPositions& to);
/// Time (s) that F gives a way of `length_mm`. Throws PS0011 without feed, PS1202 under G93 without
/// F in the block; `f_column`: of the word F, 0 without one.
double commanded_time(const motion::FeedState& feed, double length_mm, int f_column);
/// Square of what F divides on the way between two places, over the axes from the `first` letter
/// on, mm^2. A degree counts as one unit of the feed, a millimetre or, under G20, an inch: F is
/// degrees a minute for rotary axes in both (Fanuc B-63172EN p. 51: their values know no inch; that
/// F follows is assumed).
double feed_square(const offsets::ControlPosition& from, const offsets::ControlPosition& to,
                   double unit_mm, std::size_t first = 0);

}  // namespace trunnion::controller

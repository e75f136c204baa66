// Duration of a move at constant rate: length / feed, limited by the slowest axis; rapids by the
// slowest axis. motion/pace.h adds acceleration and deceleration.
#pragma once

#include "controller/modal.h"
#include "motion/axis_limits.h"
#include "offsets/control_position.h"

namespace trunnion::controller {

/// Limits of the axes from the configuration. Default rapid speeds (assumed): 24 m/min and 90
/// deg/s.
motion::AxisLimits axis_limits(const std::vector<ControlAxis>& axes);
/// Adds 1783 to the limits.
void set_corner_jumps(const ControlSettings& settings, motion::AxisLimits& limits);
/// Duration (s) of a rapid from `from` to `to`: that of the axis that takes longest at its rapid
/// speed.
double rapid_time(const motion::AxisLimits& limits, const AxisPositions& from,
                  const AxisPositions& to);
/// Duration (s) of a path of `length_mm` at feed F. Throws PS0011 without feed, PS1202 under G93
/// without F in the block. `f_column`: column of the word F, 0 without one.
double commanded_time(const motion::FeedState& feed, double length_mm, int f_column);
/// Square of the path length to which F refers between two positions, over the axes from the
/// `first` letter on, mm^2. A degree counts as one unit of the feed: a millimetre or, under G20, an
/// inch. F is thus degrees a minute for rotary axes in both units (Fanuc B-63172EN p. 51: their
/// values have no inch unit; that F follows is assumed).
double feed_square(const offsets::ControlPosition& from, const offsets::ControlPosition& to,
                   double unit_mm, std::size_t first = 0);

}  // namespace trunnion::controller

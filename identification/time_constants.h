// Time constants of the drives, from servo logs.
#pragma once

#include <string>
#include <vector>

#include "emulator/replay.h"

namespace trunnion::identification {

/// Seconds: from the least that a log could show to the longest of a drive (a heavy table without
/// feed-forward; assumed).
inline constexpr double least_time_constant_s = 2e-4, most_time_constant_s = 0.25;

/// The setup with `time_constant_s` of every axis whose servo log (30 rows or more) tells one. It
/// is that behind which velocity, acceleration and jerk explain the log best (least squares,
/// weighted by the sigma of the rows, beside a constant and the direction of travel), if they leave
/// less than without it, by 5 nats and a twentieth of the squares. It is no cause and moves nothing
/// by itself: servo.mismatch and servo.contour answer to the motion behind it (effects/servo.cpp).
/// An axis keeps what the setup tells, and stays without one where the setup tells its lag.
setup::Setup with_time_constants(setup::Setup setup, const records::ReadingTable& table);

/// A sentence for each drive whose time constant a setup tells.
std::vector<std::string> time_constant_words(const setup::Setup& setup);

}  // namespace trunnion::identification

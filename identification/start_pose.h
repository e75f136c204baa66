// Where the search for the pose of an instrument starts.
#pragma once

#include "emulator/replay.h"

namespace trunnion::identification {

/// Radians: a nearer pose is where the fit starts.
inline constexpr double pose_is_near_rad = 1e-3;

/// The setup with pose errors of its instruments of free pose that turn the commanded points of
/// each session onto the measured ones (least squares, closed form; Arun, Huang and Blostein 1987),
/// where the declared pose is more than `pose_is_near_rad` from that: a fit that starts there
/// follows derivatives of another frame. Coordinates that were not measured count as commanded.
/// Unchanged with fewer than three points, with points on one line, and where this start fits the
/// readings no better than the declared pose.
setup::Setup with_start_poses(setup::Setup setup, const records::ReadingTable& table);

}  // namespace trunnion::identification

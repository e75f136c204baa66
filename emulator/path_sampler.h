// An axis sample at any place of a move, with velocity, direction of travel and time.
#pragma once

#include "controller/motion.h"
#include "emulator/axis_tracker.h"

namespace trunnion {

/// The move as the axes execute it, started at `start_s` on the clock. Borrows move and tracker.
struct PathSampler {
    const AxisMove& move;
    const AxisTracker& tracker;
    double start_s = 0.0;
    PositioningMode mode = PositioningMode::none;  ///< function that positioned the axes
    double half_step = 1e-3;   ///< of s: neighbours from which velocity and travel are taken
    bool by_velocity = false;  ///< ballbar rows: travel is 0 for an axis that stands (formats.md)

    double time_s(double s) const { return start_s + s * move.duration_s; }
    AxisSample at(double s) const;
    /// Second difference of the commanded path, mm/s^2 and rad/s^2; 0 for moves that take no time.
    AxisPositions acceleration(double s) const;
};

}  // namespace trunnion

// An axis sample at any point of a move, with velocity, direction of travel and time. For the trace
// of the true tip and for compensation, which follow the path instead of rows.
#pragma once

#include "motion/motion.h"
#include "records/told_lines.h"
#include "records/travel.h"

namespace trunnion::emulator {

/// The move as executed by the axes, started at time `start_s`. References move and history.
struct PathSampler {
    const motion::AxisMove& move;
    const records::TravelHistory& history;
    double start_s = 0.0;
    PositioningMode mode = PositioningMode::none;  ///< function that positioned the axes
    records::ShopState shop = {};

    double time_s(double s) const { return start_s + s * move.duration_s; }
    AxisSample at(double s) const;
};

}  // namespace trunnion::emulator

// An axis sample at any place of a move, with velocity, direction of travel and time: for the trace
// of the true tip and for compensation, which follow the path itself and not rows.
#pragma once

#include "motion/motion.h"
#include "records/travel.h"

namespace trunnion::emulator {

/// What the shop set up for the readings of a run: columns of the readings that no axis word holds.
struct ShopState {
    double spindle_rad = 0.0;
    double temperature_c = 20.0;
    double load_kg = 0.0;
    bool clamped = false;
    double extension_mm = 0.0;  ///< stylus ball or cup hangs so much lower than the setup says
};

/// The move as the axes execute it, started at `start_s` on the clock. Borrows move and history.
struct PathSampler {
    const motion::AxisMove& move;
    const records::TravelHistory& history;
    double start_s = 0.0;
    PositioningMode mode = PositioningMode::none;  ///< function that positioned the axes
    ShopState shop = {};

    double time_s(double s) const { return start_s + s * move.duration_s; }
    AxisSample at(double s) const;
};

}  // namespace trunnion::emulator

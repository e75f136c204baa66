// An axis sample at any place of a move, with velocity, direction of travel and time.
#pragma once

#include "emulator/axis_tracker.h"
#include "motion/motion.h"
#include "records/readings.h"

namespace trunnion {

/// What the shop set up for the readings of a run: columns of the readings that no axis word holds.
struct ShopState {
    double spindle_rad = 0.0;
    double temperature_c = 20.0;
    double load_kg = 0.0;
    bool clamped = false;
    double extension_mm = 0.0;  ///< stylus ball or cup hangs so much lower than the setup says
};

/// The move as the axes execute it, started at `start_s` on the clock. Borrows move and tracker.
struct PathSampler {
    const AxisMove& move;
    const AxisTracker& tracker;
    double start_s = 0.0;
    PositioningMode mode = PositioningMode::none;  ///< function that positioned the axes
    double half_step = 1e-3;   ///< of s: neighbours from which velocity and travel are taken
    bool by_velocity = false;  ///< ballbar rows: travel is 0 for an axis that stands (formats.md)
    ShopState shop = {};

    double time_s(double s) const { return start_s + s * move.duration_s; }
    AxisSample at(double s) const;
    /// Second difference of the commanded path, mm/s^2 and rad/s^2; 0 for moves that take no time.
    AxisPositions acceleration(double s) const;
};

/// Writes what the shop set up into a reading.
inline void set_up_like(const ShopState& shop, Reading& row) {
    row.spindle_rad = shop.spindle_rad;
    row.temperature_c = shop.temperature_c;
    row.load_kg = shop.load_kg;
    row.clamped = shop.clamped;
    row.extension_mm = shop.extension_mm;
}

}  // namespace trunnion

// Canned cycles G73-G89: one table of how the hole is made, one routine that makes it.
#pragma once

#include <cstdint>

#include "controller/mover.h"

namespace trunnion::controller {

/// How a cycle cuts and leaves the hole. Steps: position - rapid to R - cut to Z - bottom - leave.
struct CycleRow {
    enum class Cut : std::uint8_t { straight, chip_break, full_retreat, back_boring };
    enum class Leave : std::uint8_t { rapid, feed, tap, shifted_rapid, stopped_rapid };
    int code10;
    Cut cut;
    Leave leave;
    bool dwell;  ///< P at the bottom
    const char* text;
};
const CycleRow* find_cycle(int code10);

/// Canned cycle data that stay until G80.
struct CycleData {
    double initial_level =
        0.0;               ///< program coordinate along the drilling axis when the cycle began
    double depth = 0.0;    ///< Z as programmed (absolute, or from R under G91)
    double level_r = 0.0;  ///< R as programmed (absolute, or from the initial level under G91)
    double peck = 0.0;     ///< Q
    double dwell_s = 0.0;  ///< P
    bool r_from_initial = false;  ///< R was given under G91
    bool depth_from_r = false;    ///< Z was given under G91
};

/// G73-G89: the data start anew unless a cycle is in force.
void start_cycle(CycleData& data, Modal& modal, const Frames& frames, int code10);
/// Reads R Z P Q of the block and makes the holes that its axis words command (K or L times). The
/// depth word is taken out of `words`.
void run_cycle(CycleData& data, SortedWords& words, Modal& modal, const Frames& frames,
               Mover& mover);

}  // namespace trunnion::controller

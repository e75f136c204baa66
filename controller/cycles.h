// Canned cycles G73-G89: their words, their modal data, and the holes of a block.
#pragma once

#include "controller/holes.h"

namespace trunnion::controller {

/// Canned cycle data, valid until G80.
struct CycleData {
    double initial_level = 0.0;  ///< program coordinate along the drilling axis at the start of the
                                 ///< cycle
    double depth = 0.0;          ///< Z as programmed (absolute, or from R under G91)
    double level_r = 0.0;    ///< R as programmed (absolute, or from the initial level under G91)
    double peck = 0.0;       ///< Q; on a Hurco the second Z
    double next_peck = 0.0;  ///< the same; on a Hurco the third Z
    double dwell_s = 0.0;    ///< P
    bool r_from_initial = false;  ///< R was given under G91
    bool depth_from_r = false;    ///< Z was given under G91
    bool has_r = false;           ///< R was given
};

/// G73-G89: resets the data unless a cycle is already active.
void start_cycle(CycleData& data, Modal& modal, const Frames& frames, int code10);
/// Reads R Z P Q of the block and makes the holes commanded by its axis words (K or L times). The
/// depth word is removed from `words`. BNC: Z and R are positive distances below the level where
/// the cycle began. Under M128: one hole along the tool, depth I, R above the point, not modal;
/// PS5421 without I, under G91, and for G76, G87 and G88.
void run_cycle(CycleData& data, SortedWords& words, Modal& modal, const Frames& frames,
               Mover& mover);

}  // namespace trunnion::controller

// Canned cycles G73-G89: one table of how the hole is made, one routine that makes it.
#pragma once

#include "controller/control_state.h"

namespace trunnion {

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

/// Reads R Z P Q of the block and makes the holes that its axis words command (K or L times).
void run_cycle(ControlState& c);
const CycleRow* find_cycle(int code10);

}  // namespace trunnion

// One hole of a canned cycle: one table of how it is cut and left, one routine that makes it.
#pragma once

#include <cstdint>

#include "controller/mover.h"

namespace trunnion::controller {

/// How a cycle cuts and leaves the hole. Steps: position - rapid to R - cut to Z - bottom - leave.
struct CycleRow {
    enum class Cut : std::uint8_t { straight, chip_break, full_retreat, tap_pecks, back_boring };
    enum class Leave : std::uint8_t { rapid, feed, tap, shifted_rapid, stopped_rapid };
    int code10;
    Cut cut;
    Leave leave;
    bool dwell;  ///< P at the bottom
    const char* text;
    int spindle = 0;  ///< taps: +1 M3 or -1 M4 on the way in, 0 as it turns
};
/// The row of a code on this control.
const CycleRow* find_cycle(int code10, const ControlSettings& settings);

/// What one hole is made of. Levels in mm along the drilling axis: program coordinates of the
/// plane's normal, or, with `foot`, distances from that point along `axis`.
struct HoleOrder {
    double initial = 0.0, r = 0.0, bottom = 0.0;
    double feed_from = 0.0;  ///< where the rapid down ends: R, unless a choice says otherwise
    double peck = 0.0;       ///< the first
    double next_peck = 0.0;  ///< the following
    double dwell_s = 0.0;
    std::optional<Vector3> foot;  ///< program coordinates, mm
    Vector3 axis = Vector3::UnitZ();
};

/// Goes to `place` and makes a hole there.
void make_hole(const CycleRow& row, const HoleOrder& order, const offsets::ControlPosition& place,
               Modal& modal, const Frames& frames, Mover& mover);

}  // namespace trunnion::controller

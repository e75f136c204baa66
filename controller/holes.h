// One hole of a canned cycle: a table of cutting and retracting methods, and the routine that
// executes them.
#pragma once

#include <cstdint>

#include "controller/mover.h"

namespace trunnion::controller {

/// Cutting and retracting method of a cycle. Steps: position - rapid to R - cut to Z - bottom -
/// retract.
struct CycleRow {
    enum class Cut : std::uint8_t { straight, chip_break, full_retreat, tap_pecks, back_boring };
    enum class Leave : std::uint8_t { rapid, feed, tap, shifted_rapid, stopped_rapid };
    int code10;
    Cut cut;
    Leave leave;
    bool dwell;  ///< dwell P at the bottom
    const char* text;
    int spindle = 0;  ///< tapping: +1 M3 or -1 M4 on the way in, 0 present direction
};
/// The row of a code on this control, or nullptr.
const CycleRow* find_cycle(int code10, const ControlSettings& settings);

/// Data of one hole. Levels in mm along the drilling axis: program coordinates of the plane's
/// normal or, with `foot`, distances from that point along `axis`.
struct HoleOrder {
    const CycleRow* row = nullptr;  ///< the cycle
    double initial = 0.0, r = 0.0, bottom = 0.0;
    double feed_from = 0.0;  ///< end of the rapid down: R, unless an option says otherwise
    double peck = 0.0;       ///< the first peck
    double next_peck = 0.0;  ///< the following pecks
    double dwell_s = 0.0;
    int times = 1;                ///< holes of the block
    std::optional<Vector3> foot;  ///< program coordinates, mm
    Vector3 axis = Vector3::UnitZ();
};

/// Moves to `place` and makes the hole of `order.row` there.
void make_hole(const HoleOrder& order, const offsets::ControlPosition& place, Modal& modal,
               const Frames& frames, Mover& mover);

}  // namespace trunnion::controller

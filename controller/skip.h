// G31: a straight move that ends where the skip signal comes; the place is latched in #5061...
#pragma once

#include "controller/mover.h"

namespace trunnion::controller {

/// What the skip signal left behind.
struct SkipState {
    offsets::ControlPosition work;  ///< #5061..: work frame, mm and deg
    bool triggered = false;
};

/// Present position in the work frame, mm and deg: #5041... Includes the tool length when the
/// configuration says so (default, assumed).
offsets::ControlPosition work_position(const Modal& modal, const Frames& frames);
/// PS0036 under cutter compensation. After M42 a Hurco touches twice. Without an axis word nothing
/// moves and no feed is needed.
void skip_move(SkipState& skip, const SortedWords& words, Modal& modal, const Frames& frames,
               Mover& mover);

}  // namespace trunnion::controller

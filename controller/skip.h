// G31: a straight move that ends at the skip signal; the position is latched in #5061...
#pragma once

#include "controller/mover.h"

namespace trunnion::controller {

/// Result of the last skip signal.
struct SkipState {
    offsets::ControlPosition work;  ///< #5061..: work frame, mm and deg
    bool triggered = false;
};

/// Present position in the work frame, mm and deg: #5041... Includes the tool length if so
/// configured (default, assumed).
offsets::ControlPosition work_position(const Modal& modal, const Frames& frames);
/// PS0036 under cutter compensation; 9006 for skips that do not end at the skip signal. After M42 a
/// Hurco touches twice. Without an axis word there is no motion and no feed is needed.
void skip_move(SkipState& skip, const SortedWords& words, Modal& modal, const Frames& frames,
               Mover& mover);

}  // namespace trunnion::controller

// G60: positioning that always ends in the same direction, so that backlash has no influence.
#pragma once

#include "controller/mover.h"

namespace trunnion::controller {

/// A rapid to a point before the end, then a rapid to the end: 5440 gives the distance of each axis
/// (mm, deg), its sign the direction in which the axis arrives. An axis whose way or 5440 is 0 does
/// not overrun. 9005 in a canned cycle and under cutter compensation, PS5421 under G43.4.
void position_in_one_direction(const SortedWords& words, Modal& modal, const Frames& frames,
                               Mover& mover);

}  // namespace trunnion::controller

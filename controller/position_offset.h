// G45 to G48: the move of one block longer or shorter by the offset of D.
#pragma once

#include "controller/mover.h"

namespace trunnion::controller {

/// G45 to G48: PS0042 under cutter compensation, 9005 with an arc or a thread.
void check_position_offset(const SortedWords& words, const Modal& modal);

/// End of the straight move of this block. With G45 to G48 the way of each linear axis named grows
/// by the offset (G45), shrinks by it (G46), grows or shrinks by twice the offset (G47, G48), in
/// the direction of the way. A way of 0 takes the sign of its word under G91, and stays 0 under
/// G90.
offsets::ControlPosition end_of_straight_move(const SortedWords& words, Modal& modal,
                                              const Frames& frames);

}  // namespace trunnion::controller

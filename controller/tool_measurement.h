// G37: the length of a tool is measured at a setter and written into its offset.
#pragma once

#include "controller/mover.h"

namespace trunnion::controller {

/// The axis moves towards the setter's position at rapid, the last 6251 mm at 6241 mm/min until the
/// skip signal. Stop minus programmed position is added to the offset of the active H: to its wear,
/// which memory A does not tell from geometry. The offset acts from the next H or G43.
/// PS0080 when the signal does not come within 6254 mm of the position, PS0081 without H, PS0082
/// for H in the block, PS0083 for another number of linear axes than one or under G91, PS0011
/// without 6241, 9005 under cutter compensation, G44 or G43.4.
void measure_tool_length(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover);

}  // namespace trunnion::controller

// Ways back along the tool on a Hurco: M140, M25, and G8.2, which turns the table on the way.
#pragma once

#include "controller/mover.h"

namespace trunnion::controller {

/// M140: back along the tool, L mm or to the end of a stroke (Z without a stored stroke: machine
/// zero). X Y Z of a table machine: Z alone moves.
void retract_along_tool(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover);
/// M25: Z up to the tool-change height.
void go_to_tool_change(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover);
/// G8.2: back along the tool by L or to the end of a stroke, the rotaries to their words or to the
/// vector I J K, over the point along the tool, and down to it. Only the end and that the way does
/// not dip below it are known; the way itself is assumed. Under M128 the point and the vector are
/// those of the work, in a plane those of the plane. PS5421 for rotary words beside I J K.
void reposition(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover);

}  // namespace trunnion::controller

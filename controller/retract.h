// Retracts along the tool on a Hurco: M140, M25, and G8.2, which also turns the rotary axes.
#pragma once

#include "controller/mover.h"

namespace trunnion::controller {

/// M140: retract along the tool by L mm or to a stroke limit (Z without a stored stroke: machine
/// zero). On a table machine only Z moves.
void retract_along_tool(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover);
/// M25: Z up to the tool-change height.
void go_to_tool_change(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover);
/// G8.2: retract along the tool by L or to a stroke limit; rotary axes to their words or to the
/// vector I J K; position above the point, along the tool; move down to it. Only the end position,
/// and that the path stays above it, are documented; the path itself is assumed. Under M128 point
/// and vector are given in the workpiece frame, in a tilted plane in the plane's frame. PS5421 for
/// rotary words together with I J K.
void reposition(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover);

}  // namespace trunnion::controller

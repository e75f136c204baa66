// G43, G44, G49: tool length compensation, types A, B and C (5001#0, #1), move or shift (5006#6).
#pragma once

#include "controller/mover.h"

namespace trunnion::controller {

/// G43, G44, G49. Also ends tool centre point control: G49 of G43.4 moves nothing, the axes stay
/// where they are (assumed). On a Hurco M128 continues with the other length.
void set_tool_length(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover,
                     int code10);
/// Geometry + wear of offset number H in mm; 0 for H0. PS0030 at the word H when the number does
/// not exist.
double tool_length_mm(const SortedWords& words, const offsets::ToolOffsets& tools, int number);
/// Tells a length of 0 that nothing has set.
void watch_length(const SortedWords& words, const Modal& modal, const Frames& frames, Mover& mover);
/// Activates the tool's length (`vector_mm`: tip to gauge point, rotary axes at zero). With 5006#6
/// = 0 the program position is kept and the axis moves by the change in this block; otherwise the
/// position shifts without motion.
void apply_tool_length(const ToolVector& tool, const Modal& modal, Frames& frames, Mover& mover);
/// Ends tool centre point control: the axes stay, and the position is counted without it.
void cancel_tool_centre(Frames& frames, Mover& mover);

}  // namespace trunnion::controller

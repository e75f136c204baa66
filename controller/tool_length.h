// G43, G44, G49: tool length compensation, types A, B and C (5001#0, #1), move or shift (5006#6).
#pragma once

#include "controller/mover.h"

namespace trunnion::controller {

/// G43, G44, G49; also ends tool centre point control: G49 of G43.4 moves nothing, the axes stand
/// where the tip was led to (assumed). On a Hurco M128 goes on with the other length.
void set_tool_length(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover,
                     int code10);
/// Geometry + wear of offset number H in mm; 0 for H0. PS0030 at the word H when there is none.
double tool_length_mm(const SortedWords& words, const offsets::ToolOffsets& tools, int number);
/// Puts the tool's length (`vector_mm`: tip to gauge point, rotaries at zero) in force. The program
/// position stays and the axis will move by the change with this block (5006#6 = 0), or the
/// position shifts without motion.
void apply_tool_length(const ToolVector& tool, const Modal& modal, Frames& frames, Mover& mover);
/// Tool centre point control ends: the axes stay, the position counts without it from now on.
void cancel_tool_centre(Frames& frames, Mover& mover);

}  // namespace trunnion::controller

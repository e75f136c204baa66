// G43.4 and G43.5, and M128 of a Hurco: start-up and change of length.
#pragma once

#include "controller/mover.h"

namespace trunnion::controller {

/// G43.4, G43.5. The start-up block moves like plain length compensation; tool centre point control
/// becomes active at its end (`frames.tip.starting`). PS5420 without five-axis parameters, PS5421
/// under G54.2 or cutter compensation, PS5459 for G43.5 with WKP.
void start_tool_centre(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover,
                       const GCode& code);
/// Called at the end of the start-up block. When the table is not at zero, a note gives the
/// programmed point on the table by either `tcp_frame`. A start-up block without axis words keeps
/// the programmed position; the next move goes there.
void take_over_tool_centre(const SortedWords& words, const Modal& modal, Frames& frames,
                           Mover& mover);
/// H without a code in the block: changes the offset within the active function (assumed); under
/// G43.4 along the tool, with the frame unchanged.
void change_length_number(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover);

}  // namespace trunnion::controller

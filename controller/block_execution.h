// Carries out one block of words: the fixed order of a control, whatever order they are written in.
#pragma once

#include "controller/control_state.h"
#include "interpreter/block_words.h"

namespace trunnion {

/// Sorts the words by letter and looks up the G codes. Throws PS0009, PS0010, PS5074.
void sort_words(ControlState& c, const BlockWords& block);

/// Carries out a block:
///   speed, feed and units codes - F S T - M codes that act before motion - plane, reading, work
///   offset, frame and offset codes - one-shot code or motion - M codes that act after motion.
void execute_block(ControlState& c, const BlockWords& block);

}  // namespace trunnion

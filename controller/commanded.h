// The program position commanded by the axis words of a block: G90, G91, G16, shortest way.
#pragma once

#include "controller/frames.h"

namespace trunnion::controller {

/// Starts at `frames.program`. Under G16 the pole is the origin with G90, the present position with
/// G91; each word is absolute or incremental as written, and `modal` keeps the active angle.
/// Absolute words of roll-over axes (1008#0) and under M126 move to the nearest turn; with 1008#1
/// they move in the direction of the word's sign.
offsets::ControlPosition commanded_position(const SortedWords& words, Modal& modal,
                                            const Frames& frames);

/// At G16: the active angle is that of the present position.
void start_polar_words(Modal& modal, const offsets::ControlPosition& position);

}  // namespace trunnion::controller

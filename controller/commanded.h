// The program position that the axis words of a block command: G90, G91, G16, shortest way.
#pragma once

#include "controller/frames.h"

namespace trunnion::controller {

/// From where `frames.program` stands. Under G16 with G90 the pole is the zero of the coordinates,
/// with G91 the present position; each word absolute or incremental as written, and the angle in
/// force is kept in `modal`. Absolute words of roll-over axes (1008#0) and under M126 go to the
/// nearest turn, with 1008#1 in the direction of the word's sign.
offsets::ControlPosition commanded_position(const SortedWords& words, Modal& modal,
                                            const Frames& frames);

/// At G16: the angle in force is that of the present position.
void start_polar_words(Modal& modal, const offsets::ControlPosition& position);

}  // namespace trunnion::controller

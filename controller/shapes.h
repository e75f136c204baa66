// Codes that transform the programmed figure: scaling G51, mirror image G51.1, rotation G68.
#pragma once

#include "controller/mover.h"

namespace trunnion::controller {

/// G51, G50. PS0142 for a factor of 0 or without a factor.
void set_scaling(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover);
void end_scaling(Modal& modal, Frames& frames, Mover& mover);
/// G51.1; G50.1 with axis words; G50.1 alone cancels all mirror images.
void set_mirror(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover);
void end_mirror(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover);
/// G68. PS5457 in a tilted plane (assumed).
void set_rotation(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover);
/// G69 without a tilted plane.
void end_rotation(Modal& modal, Frames& frames, Mover& mover);

}  // namespace trunnion::controller

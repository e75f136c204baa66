// G54.2 Pn: the active dynamic fixture offset. Parameters 19680-19714 are not used.
#pragma once

#include "controller/mover.h"

namespace trunnion::controller {

/// PS0031 when P does not exist, PS5421 under G43.4, PS5457 in a tilted plane.
void set_fixture_offset(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover);
/// Call after a fixture offset in the stores changed.
void fixture_sets_changed(const Modal& modal, Frames& frames, Mover& mover);

}  // namespace trunnion::controller

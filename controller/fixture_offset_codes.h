// G54.2 Pn: the dynamic fixture offset in force. It never reads 19680-19714.
#pragma once

#include "controller/mover.h"

namespace trunnion::controller {

/// PS0031 when there is no such P, PS5421 under G43.4, PS5457 inside a tilted plane.
void set_fixture_offset(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover);
/// After a set of G54.2 in the stores changed.
void fixture_sets_changed(const Modal& modal, Frames& frames, Mover& mover);

}  // namespace trunnion::controller

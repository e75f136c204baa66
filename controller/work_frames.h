// Work coordinate systems: G54-G59, G54.1, G52, G53, G92, G92.1.
#pragma once

#include "controller/mover.h"

namespace trunnion::controller {

/// G54-G59, G54.1 Pn, and G54 Pn with the same meaning. PS0031 when P does not exist, PS5421 under
/// G43.4.
void set_work_offset(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover,
                     int code10);
/// Call after a work offset in the stores changed.
void work_offset_changed(const Modal& modal, Frames& frames, Mover& mover);
/// G52, absolute under G91 too.
void set_local_shift(const SortedWords& words, const Modal& modal, Frames& frames, Mover& mover);
/// G53: a rapid to machine coordinates; ignored under G91, as on the control.
void go_to_machine_position(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover);
/// G92. The present position gets the coordinates given. G52 of these axes is cancelled, and all
/// work coordinate systems shift by the same amount. In a tilted plane the shift acts along its
/// axes and ends with it (assumed). S limits the speed of G96.
void preset_position(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover);
/// G92.1
void cancel_preset(const SortedWords& words, const Modal& modal, Frames& frames, Mover& mover);

}  // namespace trunnion::controller

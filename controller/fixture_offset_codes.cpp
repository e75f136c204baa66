#include "controller/fixture_offset_codes.h"

#include "controller/alarms.h"

namespace trunnion::controller {

void set_fixture_offset(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover) {
    if (frames.tip.in_force) raise_alarm(5421, "(G54.2 under it)");
    if (frames.plane) raise_alarm(5457, "(G54.2 inside a tilted plane)");
    const int p = words.whole('P');
    modal.codes.set(ModalGroup::fixture, p == 0 ? 0 : 542);
    frames.fixture_number = p;
    frames.stages.fixture = {};
    if (p != 0 && frames.fixture_settings(modal.settings).assumed)
        mover.note("G54.2: groups 7580-7588 are not given; a left-handed rotary table is assumed");
    fixture_sets_changed(modal, frames, mover);
}

void fixture_sets_changed(const Modal& modal, Frames& frames, Mover& mover) {
    frames.turn_fixture(modal.settings, frames.machine);
    mover.frames_changed();
}

}  // namespace trunnion::controller

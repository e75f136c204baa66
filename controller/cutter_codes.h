// G41, G42, G40, G39 and the moves that pass through cutter compensation. Start-up and cancel types
// A, B, C (5003#0, #1), outside corners by lines or arcs (19607#2) and look-ahead (19625) are in
// the room cutter.
#pragma once

#include "controller/mover.h"

namespace trunnion::controller {

/// D is modal and needs no code in its block; its radius counts from the next side on. PS0030 for
/// an offset number that does not exist.
void take_radius_number(const SortedWords& words, Modal& modal, const Frames& frames);
/// Tells a radius of 0 that nothing has set.
void watch_radius(const SortedWords& words, const Modal& modal, const Frames& frames, Mover& mover);
/// G40, G41, G42. PS0034 in an arc block.
void set_cutter(const SortedWords& words, Modal& modal, const Frames& frames, Mover& mover,
                int code10);
/// G39: an arc round the end of the previous move. PS0010 without G41, G42 or with an axis word.
void corner_arc(const SortedWords& words, const Modal& modal, Mover& mover);
/// True when moves of this block must pass through cutter compensation.
bool uses_cutter_path(const SortedWords& words, const Mover& mover);
/// G0 G1 G2 G3 through cutter compensation.
void queue_motion(const SortedWords& words, Modal& modal, const Frames& frames, Mover& mover);
/// True when a code of the block changes frames or moves by itself: the compensated path ends
/// before it.
bool pauses_path(const SortedWords& words);

}  // namespace trunnion::controller

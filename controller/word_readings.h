// Codes that change the interpretation of words: units, plane, feed; also F and dwell.
#pragma once

#include "controller/mover.h"

namespace trunnion::controller {

/// Unit of the F word of this block, in mm/min, inch/min or per revolution.
double feed_word_unit(const SortedWords& words, const Modal& modal);
/// G20, G21: the feed speed stays the same.
void change_units(Modal& modal, int code10);
/// G17, G18, G19; PS0037 under cutter compensation.
void change_plane(Modal& modal, int code10);
/// G93, G94, G95: changing the mode cancels F.
void change_feed_mode(Modal& modal, int code10);
/// P of G4 and of cycles in s: written in ms, on a Hurco in s.
double dwell_word_s(const SortedWords& words, const Modal& modal);
/// G4 P, X or U (s); PS0006 when negative.
void dwell(const SortedWords& words, const Modal& modal, Mover& mover);

}  // namespace trunnion::controller

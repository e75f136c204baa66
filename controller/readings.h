// How words are read: the unit of F without a decimal point.
#pragma once

namespace trunnion {

struct ControlState;

/// What one unit of the F word of this block means, in mm/min, inch/min or a turn.
double feed_word_unit(const ControlState& c);

}  // namespace trunnion

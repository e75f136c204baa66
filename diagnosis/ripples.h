// Ripples need places: which periods of an axis its positions can show.
#pragma once

#include <optional>

#include "diagnosis/candidate_groups.h"

namespace trunnion::diagnosis {

/// A period (mm or rad) is shown by 8 distinct places or more, two whole turns inside the range, no
/// hole in the phase above 0.4 of a turn, and, where all places lie on an even grid, two of its
/// steps or more.
bool shows_period(std::vector<double> places, double period);

/// The effect at one setting of its keys, when the positions of its axis can show it and no
/// textbook effect of that axis is the same on these readings (a fifth of its columns or more lies
/// outside theirs).
std::optional<std::size_t> add_ripple_or_other(Design& design, const Prepared& prepared,
                                               const Whitener& whitener,
                                               const effects::Effect& effect,
                                               std::vector<double> keys);

}  // namespace trunnion::diagnosis

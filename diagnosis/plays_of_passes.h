// A play beside passes that each begin at a zero of their own (plays_of_passes.cpp).
#pragma once

#include <vector>

#include "diagnosis/diagnosis_report.h"

namespace trunnion::diagnosis {

/// A play is constant within a pass of a laser or an autocollimator, as is the zero of that pass.
/// Where passes of one direction differ by more than their noise, each pass is one reading of the
/// play, however many targets it has: a claim of it is no more probable than Student's t of the
/// means of the passes, or of the differences of there and back, whichever tells more. At least
/// three passes are needed to see that zeros differ.
void doubt_plays_of_passes(const Outcome& found, std::vector<Claim>& claims);

}  // namespace trunnion::diagnosis

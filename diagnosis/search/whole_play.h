// A play that changes along the travel, as a whole (whole_play.cpp).
#pragma once

#include "diagnosis/search/search.h"

namespace trunnion::diagnosis {

/// The best of a model and of those with the play of an axis and its table together. The table is
/// orthogonal to what is the same everywhere, so a play at one end of the travel needs both, and
/// each alone may leave too much to be worth its prior. `seen`: the model with the noise from which
/// the search starts.
Model with_whole_play(Design& design, const SearchSetting& setting, const Model& model,
                      const Model& seen);

}  // namespace trunnion::diagnosis

// How far the rows of a log are from their points of a path.
#pragma once

#include <vector>

#include "choices/pairing.h"

namespace trunnion::choices {

/// Sum of squares of all pairs of a row, each axis divided by its uncertainty; one value a row.
std::vector<double> row_losses(const LogView& log, const std::vector<Pair>& pairs);

}  // namespace trunnion::choices

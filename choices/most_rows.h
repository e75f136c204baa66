// Fit of stored numbers to most rows of a log, beside blocks that another cause has.
#pragma once

#include "choices/store_columns.h"

namespace trunnion::choices {

/// Least squares in which a row counts the less, the farther it stays away. False, and nothing is
/// changed, if the other rows do not come closer by it.
bool fit_to_most_rows(const Comparer& comparer, const Numbers& numbers, FittedControl& control);

}  // namespace trunnion::choices

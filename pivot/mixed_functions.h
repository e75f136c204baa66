// Detects prints with wrong function names: the readings fit a machine under other names only.
#pragma once

#include <string>
#include <vector>

#include "pivot/pivot_verdict.h"

namespace trunnion::pivot {

/// Functions that used the stores of the other group than their name indicates: with these assigned
/// to the other group the readings fit a machine three times better. Empty: none, or the readings
/// fit within 3 µm as named. `as_named` is the fit of `maps` as given.
std::vector<std::string> mixed_functions(const PivotEvidence& evidence,
                                         const std::vector<PivotMap>& maps,
                                         const PivotFit& as_named);

}  // namespace trunnion::pivot

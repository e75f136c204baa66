// Prints whose functions were mixed up: read under other names they fit a machine, as named not.
#pragma once

#include <string>
#include <vector>

#include "pivot/pivot_verdict.h"

namespace trunnion::pivot {

/// Functions that took their stores from the other group than their name says: with those counted
/// to the other group the readings fit a machine three times better. Empty: none, or the readings
/// already fit within 3 µm as named. `as_named` is the fit of `maps` as they are.
std::vector<std::string> mixed_functions(const PivotEvidence& evidence,
                                         const std::vector<PivotMap>& maps,
                                         const PivotFit& as_named);

}  // namespace trunnion::pivot

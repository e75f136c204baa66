// The verdict of a comparison in one line.
#pragma once

#include <string>

#include "regression/comparison.h"
#include "regression/segment.h"

namespace trunnion::regression {

/// Requires status, layers and differences of the comparison.
std::string verdict_of(const Comparison& comparison, const Tolerances& tolerances);

}  // namespace trunnion::regression

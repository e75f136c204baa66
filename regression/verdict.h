// The one line that answers a comparison.
#pragma once

#include <string>

#include "regression/comparison.h"
#include "regression/segment.h"

namespace trunnion::regression {

/// For a comparison whose status, layers and differences stand.
std::string verdict_of(const Comparison& comparison, const Tolerances& tolerances);

}  // namespace trunnion::regression

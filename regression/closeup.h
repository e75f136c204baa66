// The place where two stretches have their largest distance, with the surrounding paths.
#pragma once

#include <optional>

#include "regression/comparison.h"
#include "regression/path_record.h"
#include "regression/path_region.h"

namespace trunnion::regression {

/// Empty where a side has no path nearby, or where the stretches are within tolerance. Of long
/// stretches only the first 400 segments are examined.
std::optional<ComparePicture::Closeup> closeup_of(const PathRecord& a, Stretch in_a,
                                                  const PathRecord& b, Stretch in_b,
                                                  const Tolerances& tolerances);

}  // namespace trunnion::regression

// The place where two stretches of path lie farthest apart, with the paths around it.
#pragma once

#include <optional>

#include "regression/comparison.h"
#include "regression/path_record.h"
#include "regression/path_region.h"

namespace trunnion::regression {

/// Nothing where a side has no path near, or where the stretches lie within the tolerance. Long
/// stretches are looked at in their first 400 segments.
std::optional<ComparePicture::Closeup> closeup_of(const PathRecord& a, Stretch in_a,
                                                  const PathRecord& b, Stretch in_b,
                                                  const Tolerances& tolerances);

}  // namespace trunnion::regression

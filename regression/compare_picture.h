// Both paths thinned out for the picture of a report.
#pragma once

#include <vector>

#include "regression/comparison.h"
#include "regression/path_record.h"
#include "regression/path_region.h"

namespace trunnion::regression {

/// Cuts and rapids of both sides, of many passes evenly chosen ones, and the first regions as
/// marks. Nothing without regions.
void draw_paths(const std::vector<PathRegion>& marked_regions, const PathRecord& a,
                const PathRecord& b, const Tolerances& tolerances, ComparePicture& picture);

}  // namespace trunnion::regression

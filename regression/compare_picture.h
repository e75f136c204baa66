// Both paths thinned out for the picture of a report.
#pragma once

#include <vector>

#include "regression/comparison.h"
#include "regression/path_record.h"
#include "regression/path_region.h"

namespace trunnion::regression {

/// Both paths and where they lie farthest apart.
struct PictureInput {
    const PathRecord &a, &b;
    const Tolerances& tolerances;
    Stretch worst_a, worst_b;
    std::size_t worst_difference = 0;  ///< to which that place belongs
};

/// Cuts and rapids of both sides, of many passes evenly chosen ones, the first regions as marks,
/// the first one that lies apart and the worst place from near. Nothing without regions.
void draw_paths(const std::vector<PathRegion>& marked_regions, const PictureInput& input,
                ComparePicture& picture);

}  // namespace trunnion::regression

// Both paths, thinned out for the picture of a report.
#pragma once

#include <vector>

#include "regression/comparison.h"
#include "regression/path_record.h"
#include "regression/path_region.h"

namespace trunnion::regression {

/// Both paths and the place of their largest distance.
struct PictureInput {
    const PathRecord &a, &b;
    const Tolerances& tolerances;
    Stretch worst_a, worst_b;
    std::size_t worst_difference = 0;  ///< the difference to which that place belongs
};

/// Cuts and rapids of both sides (an even selection of many passes), the first regions as marks,
/// and close-ups of the first different region and of the worst place. Nothing without regions.
void draw_paths(const std::vector<PathRegion>& marked_regions, const PictureInput& input,
                ComparePicture& picture);

}  // namespace trunnion::regression

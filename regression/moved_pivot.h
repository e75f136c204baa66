// Many shifts, one cause: a pivot or a tool length that one of the posts has wrong.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "regression/path_compare.h"
#include "regression/recorded_run.h"

namespace trunnion::regression {

struct MovedPivotInput {
    const RecordedRun& a;
    const std::optional<positioning::RotaryTransform>& transform;
    Tolerances tolerances;
};

struct MovedPivot {
    std::string text;
};

/// With the table turned by R, a post whose pivot is off by p puts the tip off by (R' - I) p in the
/// table frame, and one whose length is off by l by l along the tool. Says so when at least two
/// tool directions occur and all shifts fit within twice the tolerance.
std::optional<MovedPivot> moved_pivot(const std::vector<PathCluster>& clusters,
                                      const MovedPivotInput& input);

}  // namespace trunnion::regression

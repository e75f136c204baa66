// Many shifts, one cause: a pivot or a tool length that one of the posts has wrong.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "regression/path_compare.h"
#include "regression/recorded_run.h"

namespace trunnion::regression {

struct MovedPivotInput {
    const RecordedRun &a, &b;
    const std::optional<positioning::RotaryTransform>& transform;
    Tolerances tolerances;
};

/// Each shift is turned * pivot_mm + length_mm * direction, turned = R' - I of its pose.
struct MovedPivot {
    std::string text;
    Vector3 pivot_mm = Vector3::Zero();
    double length_mm = 0.0;
};

/// With the table turned by R, a post whose pivot is off by p puts the tip off by (R' - I) p in the
/// table frame, and one whose length is off by l by l along the tool. Says so when at least two
/// tool directions occur and all shifts fit within twice the tolerance.
std::optional<MovedPivot> moved_pivot(const std::vector<PathCluster>& clusters,
                                      const MovedPivotInput& input);

/// True when each corner of a stretch of A stands in B at its own place or at the shifted one, and
/// some at the shifted one: the ways to a shifted section belong to its cause.
bool explains(const MovedPivot& moved, const PathCluster& cluster, const MovedPivotInput& input);

}  // namespace trunnion::regression

// One cause for many shifts: a wrong pivot or tool length in one of the post processors.
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

/// Each shift is turned * pivot_mm + length_mm * direction, with turned = R' - I of its pose.
struct MovedPivot {
    std::string text;
    Vector3 pivot_mm = Vector3::Zero();
    double length_mm = 0.0;
};

/// With the table rotated by R, a pivot error p of the post processor moves the tip by (R' - I) p
/// in the table frame, and a length error l moves it by l along the tool. Returned if at least two
/// tool directions occur and all shifts fit within twice the tolerance.
std::optional<MovedPivot> moved_pivot(const std::vector<PathCluster>& clusters,
                                      const MovedPivotInput& input);

/// True when each corner of a stretch of A exists in B at its own or at the shifted place, and some
/// at the shifted one: the paths to a shifted section have the same cause.
bool explains(const MovedPivot& moved, const PathCluster& cluster, const MovedPivotInput& input);

}  // namespace trunnion::regression

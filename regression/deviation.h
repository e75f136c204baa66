// How far two stretches of path lie apart, and whether one is the other shifted.
#pragma once

#include <optional>

#include "regression/frechet.h"

namespace trunnion::regression {

struct Deviation {
    double position_mm = 0.0;
    double direction_rad = 0.0;
};

/// Hausdorff distance of the two chord lines (each point of one from the other line), long
/// stretches thinned out to some hundred points. An empty stretch is the point where it would
/// begin.
Deviation deviation_between(SegmentWindow& a_path, Stretch a, SegmentWindow& b_path, Stretch b,
                            const Tolerances& tolerances);

/// The one vector by which B's corners are shifted against A's; nothing when there is none, when
/// the counts differ, or when it is within tolerance. `closed`: the last corners are common again.
std::optional<Vector3> common_shift(SegmentWindow& a_path, Stretch a, SegmentWindow& b_path,
                                    Stretch b, const Tolerances& tolerances);

}  // namespace trunnion::regression

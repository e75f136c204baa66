// Distance of two stretches of path, and detection of a pure shift.
#pragma once

#include <optional>

#include "regression/frechet.h"

namespace trunnion::regression {

struct Deviation {
    double position_mm = 0.0;
    double direction_rad = 0.0;
};

/// Hausdorff distance of the two chord lines (each point of one from the other line); long
/// stretches are thinned out to some hundred points. An empty stretch is its start point. Where one
/// begins or ends within a block of the other, the blocks beside it count as a part of its line.
Deviation deviation_between(SegmentWindow& a_path, Stretch a, SegmentWindow& b_path, Stretch b,
                            const Tolerances& tolerances);

/// The constant vector by which B's corners are shifted relative to A's; empty when there is none,
/// when the numbers of corners differ, or when it is within tolerance. `closed`: the last corners
/// are common again.
std::optional<Vector3> common_shift(SegmentWindow& a_path, Stretch a, SegmentWindow& b_path,
                                    Stretch b, const Tolerances& tolerances);

}  // namespace trunnion::regression

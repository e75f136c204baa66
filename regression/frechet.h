// Exact decision whether two stretches of path are equal within tolerance, independent of their
// segmentation.
#pragma once

#include <cstdint>

#include "regression/chords.h"
#include "regression/segment_file.h"

namespace trunnion::regression {

/// A stretch of a path: segments first..last, last excluded. It starts at the end of segment first
/// - 1, so first >= 1.
struct Stretch {
    std::uint64_t first = 1;
    std::uint64_t last = 1;
};

/// One side of a comparison: the corner to find lies after segment `beyond`.
struct WalkedSide {
    SegmentWindow& path;
    Stretch stretch;
    std::uint64_t beyond = 0;
};

/// Result of comparing two stretches.
struct FrechetResult {
    bool reached = false;        ///< a common corner was reached, before segments a and b
    std::uint64_t a = 0, b = 0;  ///< reached: the next segments; otherwise the first that do not
                                 ///< agree
    double position_mm = 0.0;    ///< largest distance so far of a corner of one path from the other
                                 ///< path
    double direction_rad = 0.0;
};

/// Traverses the free-space diagram of Alt and Godau (1995), one column for each chord of A,
/// keeping only the reachable part. Starts at a common corner before the first segments of both
/// stretches; ends at the next common corner that ends a segment on both sides and lies after both
/// segments `beyond`. Segments of different kind (rapid, feed) never match. Never throws. Linear
/// time where the paths agree.
FrechetResult next_common_corner(WalkedSide a, WalkedSide b, const Tolerances& tolerances);

}  // namespace trunnion::regression

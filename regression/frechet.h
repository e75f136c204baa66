// Are two stretches of path equal within tolerance, however they are cut? The exact decision.
#pragma once

#include <cstdint>

#include "regression/chords.h"
#include "regression/segment_file.h"

namespace trunnion::regression {

/// A stretch of a path: segments first..last (last not included); it starts at the end of segment
/// first - 1, so first >= 1.
struct Stretch {
    std::uint64_t first = 1;
    std::uint64_t last = 1;
};

/// How far two stretches agree.
struct FrechetResult {
    bool reached = false;        ///< a common corner was reached: both before segment a and b
    std::uint64_t a = 0, b = 0;  ///< reached: the next segments; else: the first that do not agree
    double position_mm = 0.0;  ///< largest distance of a corner of one path from the other, so far
    double direction_rad = 0.0;
};

/// Walks the free-space diagram of Alt and Godau (1995), a column for each chord of A, keeping only
/// the reachable part, from a common corner before segments a.first and b.first to the next common
/// corner that ends a segment on both sides and lies beyond segments `a_beyond` and `b_beyond`.
/// Segments of different kind (rapid, feed) never match. Throws nothing; linear where paths agree.
FrechetResult next_common_corner(SegmentWindow& a_path, Stretch a, SegmentWindow& b_path, Stretch b,
                                 const Tolerances& tolerances, std::uint64_t a_beyond = 0,
                                 std::uint64_t b_beyond = 0);

}  // namespace trunnion::regression

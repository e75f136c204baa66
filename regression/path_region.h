// A stretch on which two paths differ, before anything is said about it.
#pragma once

#include "regression/frechet.h"

namespace trunnion::regression {

/// How a region differs. `moved`: the same path shifted by one vector.
enum class RegionKind : std::uint8_t { moved, path, only_a, only_b, feed, spindle, coolant, tool };

struct PathRegion {
    RegionKind kind = RegionKind::path;
    Stretch a, b;              ///< the differing segments; empty: nothing on that side
    double position_mm = 0.0;  ///< largest distance of one path from the other there
    double direction_rad = 0.0;
    Vector3 shift_mm = Vector3::Zero();   ///< B minus A (moved)
    double value_a = 0.0, value_b = 0.0;  ///< feed mm/min, spindle rpm, coolant 0/1, tool number
    /// Along how much, without a break, feed, spindle, coolant or tool differ; the run at hand and
    /// where on A it ends.
    double length_mm = 0.0, run_mm = 0.0, run_end_mm = 0.0;
};

}  // namespace trunnion::regression

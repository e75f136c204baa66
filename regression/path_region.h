// A stretch on which two paths differ, before interpretation.
#pragma once

#include "regression/frechet.h"

namespace trunnion::regression {

/// Kind of a difference. `moved`: the same path with a constant shift.
enum class RegionKind : std::uint8_t { moved, path, only_a, only_b, feed, spindle, coolant, tool };

struct PathRegion {
    RegionKind kind = RegionKind::path;
    Stretch a, b;              ///< the differing segments; empty: none on that side
    double position_mm = 0.0;  ///< largest distance of the paths in the region
    double direction_rad = 0.0;
    Vector3 shift_mm = Vector3::Zero();   ///< B minus A (moved)
    double value_a = 0.0, value_b = 0.0;  ///< feed mm/min, spindle rpm, coolant 0/1, tool number
    /// Length without interruption on which feed, spindle, coolant or tool differ; length and end
    /// on A of the current run.
    double length_mm = 0.0, run_mm = 0.0, run_end_mm = 0.0;
};

}  // namespace trunnion::regression

// Linear axes U V W parallel to X, Y or Z: table, quill, ram.
#pragma once

#include "geometry/axes.h"
#include "geometry/pose.h"

namespace trunnion::inline geometry {

/// Parameter 1022 = 5, 6, 7 of U, V, W: a + command moves the tool in the direction of +X, +Y, +Z.
struct ParallelAxes {
    std::array<signed char, 3> beside{-1, -1, -1};  ///< for U V W: parallel to 0 X, 1 Y, 2 Z, -1
                                                    ///< none

    /// X Y Z of the gauge point, including the contributions of U V W.
    Vector3 linear(const AxisPositions& q) const {
        Vector3 sum(q.value[0], q.value[1], q.value[2]);
        for (std::size_t i = 0; i < 3; ++i)
            if (beside[i] >= 0) sum[beside[i]] += q.value[index_of(Axis::U) + i];
        return sum;
    }
    friend bool operator==(const ParallelAxes&, const ParallelAxes&) = default;
};

}  // namespace trunnion::inline geometry

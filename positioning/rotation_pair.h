// Two rotations that align two directions: the core of every inverse orientation problem.
#pragma once

#include <optional>

#include "geometry/pose.h"

namespace trunnion::positioning {

/// One solution of Rot(a, alpha) x = Rot(b, beta) y. An angle without influence is empty.
struct PairSolution {
    std::optional<double> alpha_rad;  ///< empty: free, x lies on the line of a
    std::optional<double> beta_rad;   ///< empty: free, y lies on the line of b
};

/// Zero, one or two solutions.
struct PairSolutions {
    int count = 0;
    PairSolution at[2];
};

/// All solutions of Rot(a, alpha) x = Rot(b, beta) y for unit vectors a, x, b, y; angles in (-pi,
/// pi]. The common vector lies on the cone of x about a and on the cone of y about b, so there are
/// at most two, mirror images in the plane of a and b. Directions up to 1e-9 beyond the reach count
/// as at its limit. Singular cases: parallel axes give no solution; x within 1e-11 of the line of a
/// makes alpha free, y within 1e-11 of the line of b makes beta free.
PairSolutions solve_rotation_pair(const Vector3& a, const Vector3& x, const Vector3& b,
                                  const Vector3& y);

}  // namespace trunnion::positioning

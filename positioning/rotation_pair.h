// Two turns that bring two directions together: the core of every orientation inverse.
#pragma once

#include <optional>

#include "geometry/pose.h"

namespace trunnion::positioning {

/// One way to satisfy Rot(a, alpha) x = Rot(b, beta) y. An angle that nothing depends on is free.
struct PairSolution {
    std::optional<double> alpha_rad;  ///< nothing: free (x lies on the line of a)
    std::optional<double> beta_rad;   ///< nothing: free (y lies on the line of b)
};

/// Zero, one or two solutions.
struct PairSolutions {
    int count = 0;
    PairSolution at[2];
};

/// All angles with Rot(a, alpha) x = Rot(b, beta) y; unit vectors, angles in (-pi, pi]. The common
/// vector lies on the cone of x about a and on the cone of y about b, so there are up to two of
/// them, mirror images in the plane of a and b. None for parallel axes.
PairSolutions solve_rotation_pair(const Vector3& a, const Vector3& x, const Vector3& b,
                                  const Vector3& y);

}  // namespace trunnion::positioning

// The touch probe: where a stylus ball on its path touches a sphere, and where the skip signal
// latches.
#pragma once

#include <functional>
#include <optional>

#include "geometry/pose.h"
#include "kinematics/machine.h"

namespace trunnion::probe {

/// The physical stylus.
struct TouchProbe {
    Vector3 tip_S_mm = Vector3(0, 0, -150);  ///< stylus ball centre in S
    double ball_diameter_mm = 6.0;
};

/// A sphere on the table.
struct SphereTarget {
    Vector3 center_W_mm = Vector3::Zero();
    double diameter_mm = 25.4;
};

/// Vector from the sphere centre to the stylus ball centre, in M, mm.
Vector3 centre_to_tip_M(const kinematics::MachinePose& poses, const TouchProbe& probe,
                        const SphereTarget& sphere);

/// Distance of the two centres at contact, mm.
inline double reach_mm(const TouchProbe& probe, const SphereTarget& sphere) {
    return 0.5 * (sphere.diameter_mm + probe.ball_diameter_mm);
}

/// Distance along the unit vector `direction` to the first position where `separation` (centre to
/// tip) has the length `reach_mm`, in closed form; negative when that position lies behind. `meets`
/// false: the ball misses the sphere, and the distance is that to the point of closest approach.
struct WayToSphere {
    double way_mm = 0.0;
    bool meets = true;
};
WayToSphere way_to_sphere(const Vector3& separation, const Vector3& direction, double reach_mm);

/// Vector from sphere centre to ball centre (mm) at s in [0, 1] of a move; smooth in s.
using Separation = std::function<Vector3(double)>;

/// The first s in [0, 1] at which the separation has the length `reach_mm` (sum of the radii):
/// accurate to 1e-9 mm of path; contacts deeper than 1e-6 mm are never missed. 0 when in contact at
/// the start, empty when the path ends before.
std::optional<double> first_contact(const Separation& separation, double reach_mm);

}  // namespace trunnion::probe

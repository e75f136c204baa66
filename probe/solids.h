// Solids that a stylus ball meets: exact distances, and the first contact on a path.
#pragma once

#include <functional>
#include <optional>
#include <span>

#include "geometry/pose.h"

namespace trunnion::probe {

/// A box, or a ring about Z: what lies between two cylinders; mm, in the frame of its body.
struct Solid {
    bool round = false;
    Vector3 low = Vector3::Zero(), high = Vector3::Zero();  ///< box; of a ring the z alone counts
    double inner_mm = 0.0, outer_mm = 0.0;  ///< radii of a ring, inner 0: a cylinder
};

/// From a point to the nearest point of the solid, exact outside of it; negative inside.
double distance_mm(const Solid& solid, const Vector3& point_mm);
/// To the nearest of several.
double distance_mm(std::span<const Solid> solids, const Vector3& point_mm);

/// Centre of the ball (mm) at s in [0, 1] of a move.
using BallPath = std::function<Vector3(double)>;

/// The first s at which the ball's surface meets one of the solids: root found to 1e-9 mm, contacts
/// deeper than 1e-6 mm are not stepped over. 0 when it is in contact at the start, nothing when it
/// meets none.
std::optional<double> first_contact(std::span<const Solid> solids, const BallPath& ball,
                                    double radius_mm);

}  // namespace trunnion::probe

// Solids touched by a stylus ball: exact distances, and the first contact on a path.
#pragma once

#include <functional>
#include <optional>
#include <span>

#include "geometry/pose.h"

namespace trunnion::probe {

/// A box, or a ring about Z (the volume between two cylinders); mm, in the frame of its body.
struct Solid {
    bool round = false;
    Vector3 low = Vector3::Zero(), high = Vector3::Zero();  ///< corners of the box; of a ring only
                                                            ///< z is used
    double inner_mm = 0.0, outer_mm = 0.0;  ///< radii of a ring; inner 0: a full cylinder
};

/// Signed distance (mm) from a point to the surface: exact outside, negative inside.
double distance_mm(const Solid& solid, const Vector3& point_mm);
/// Distance to the nearest of several solids.
double distance_mm(std::span<const Solid> solids, const Vector3& point_mm);

/// Centre of the ball (mm) at s in [0, 1] of a move.
using BallPath = std::function<Vector3(double)>;

/// The first s at which the ball touches one of the solids: accurate to 1e-9 mm of path; contacts
/// deeper than 1e-6 mm are never missed. 0 when in contact at the start, empty without contact.
std::optional<double> first_contact(std::span<const Solid> solids, const BallPath& ball,
                                    double radius_mm);

}  // namespace trunnion::probe

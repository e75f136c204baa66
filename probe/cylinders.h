// A tool against the disc of a tool setter: the distance of two cylinders at any angle, and the
// first contact on a path.
#pragma once

#include <functional>
#include <optional>

#include "geometry/pose.h"

namespace trunnion::probe {

/// Flat at both ends.
struct Cylinder {
    Vector3 end_mm = Vector3::Zero();  ///< middle of one end
    Vector3 axis = Vector3::UnitZ();   ///< unit vector from there to the other end
    double length_mm = 0.0, radius_mm = 0.0;
};

/// Clearance (mm) between the two volumes: zero at contact within 1e-10 mm, negative when they
/// overlap, positive and at most their distance when they are apart.
double clearance_mm(const Cylinder& a, const Cylinder& b);

/// The cylinder at s in [0, 1] of a move.
using CylinderPath = std::function<Cylinder(double)>;

/// The first s at which the moving cylinder touches the other one, as first_contact of a ball.
std::optional<double> first_contact(const Cylinder& still, const CylinderPath& moving);

}  // namespace trunnion::probe

// Intersection tests for lines and arcs in a plane.
#pragma once

#include "geometry/plane_path.h"

namespace trunnion::inline geometry {

/// True when a point of the element's line or circle is within the length of the element.
/// `slack_mm` extends both ends.
bool within(const PlaneElement& e, PlanePoint p, double slack_mm);
/// True when the elements have a common point (tolerance 1e-6 mm).
bool touch(const PlaneElement& a, const PlaneElement& b);
/// True when the elements cross or one ends on the other. Tangency does not count, nor does a `b`
/// that starts at the end of `a`.
bool cross_over(const PlaneElement& a, const PlaneElement& b);

}  // namespace trunnion::inline geometry

// Whether two lines or arcs of a plane meet.
#pragma once

#include "geometry/plane_path.h"

namespace trunnion::inline geometry {

/// Is a point of the element's line or circle within its length? `slack_mm` widens both ends.
bool within(const PlaneElement& e, PlanePoint p, double slack_mm);
/// Do the elements share a point (1e-6 mm)?
bool touch(const PlaneElement& a, const PlaneElement& b);
/// Do the elements cross or end on each other? Touching in passing (tangents) does not count, nor
/// does `b` that starts where `a` ends.
bool cross_over(const PlaneElement& a, const PlaneElement& b);

}  // namespace trunnion::inline geometry

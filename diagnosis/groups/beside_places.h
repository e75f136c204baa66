// Courses of time beside the errors of an axis (beside_places.cpp).
#pragma once

#include <Eigen/Core>

#include "diagnosis/prepare/prepare.h"

namespace trunnion::diagnosis {

/// Whitened columns of a driver, made orthogonal to all that depends on the position of the axis,
/// where a laser, an autocollimator or a reference encoder reads one axis, which passes its places
/// again. A pass at even speed is a course of
/// time: what both could be is an error of the axis, and time has what differs from pass to pass.
/// Other readings: unchanged.
Eigen::MatrixXd beside_places(const Prepared& prepared, const Whitener& whitener,
                              Eigen::MatrixXd white);

}  // namespace trunnion::diagnosis

// Courses of time beside the errors of an axis (beside_places.cpp).
#pragma once

#include <Eigen/Core>

#include "diagnosis/prepare/prepare.h"

namespace trunnion::diagnosis {

/// Whitened columns of a driver, made orthogonal to all that depends on the position of the axis,
/// where a laser, an autocollimator or a reference encoder reads one axis, which passes its places
/// again; `by_side`: where most places were read twice from each side, to all that depends on
/// position and side. A pass at even speed is a course of time, and a play that winds up behind
/// each reversal comes and goes with time: what both could be is an error of the axis, and time has
/// what differs from pass to pass, or from cycle to cycle. Other readings: unchanged.
Eigen::MatrixXd beside_places(const Prepared& prepared, const Whitener& whitener,
                              Eigen::MatrixXd white, bool by_side);

}  // namespace trunnion::diagnosis

// Noise told by readings of one place from both sides (both_sides.cpp).
#pragma once

#include "diagnosis/prepare/near_readings.h"
#include "diagnosis/prepare/noise.h"

namespace trunnion::diagnosis {

/// Variance of residuals by the lines of a laser or an autocollimator that were read there and
/// back. Both readings of a target in one cycle share its error, so their difference holds the
/// reversal and the noise of both; from one target to the next one the reversal hardly changes, so
/// the change of the difference is noise (von Neumann). Spoiled changes do not count
/// (estimation/scatter.h). `white`: residuals in sigma by device row; `least`: no noise is below.
NeighbourNoise noise_of_sides(const RepeatedRows& rows, const Eigen::VectorXd& white, double least);

}  // namespace trunnion::diagnosis

// Noise told by neighbours, where nobody states it and nothing was read twice
// (near_readings.cpp).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "diagnosis/prepare/noise.h"
#include "emulator/replay.h"

namespace trunnion::diagnosis {

/// Noise that neighbours tell.
struct NeighbourNoise {
    double variance = 0.0;  ///< relative to that of the sigmas; 0 below 20 pairs
    double doubt = 0.0;     ///< standard deviation of the variance, relative
    double alike = 0.0;     ///< by how many deviations neighbours are off alike, as no noise is
};

/// Variance of residuals that neighbours do not share: half the square of the difference of each
/// reading and the nearest one of the same device and direction, by the positions of the axes in
/// parts of their ranges, within a quarter (the joints of an arm have hardly any). The direction is
/// the same seen from the bed, from the table or from the tool: the two readings of a star turn
/// with the telescope. Errors that follow the position are alike there and cancel; what is left is
/// noise, or finer than the distance of the readings. The largest quarter does not count, so that a
/// few spoiled readings do not matter. Only static readings in places of their own, which an
/// instrument takes one by one (angle, point). Residuals and sigmas by device row.
NeighbourNoise noise_of_neighbours(const emulator::Replay& replay, const std::vector<bool>& used,
                                   const Eigen::VectorXd& left_mm, const Eigen::VectorXd& sigma_mm);

/// The same of successive rows of a servo log: half the squares of their differences. What comes
/// and goes in many rows cancels, and is no noise.
NeighbourNoise noise_of_successive(const emulator::Replay& replay,
                                   const std::vector<NoiseBlock>& blocks,
                                   const std::vector<bool>& used, const Eigen::VectorXd& left_mm,
                                   const Eigen::VectorXd& sigma_mm);

}  // namespace trunnion::diagnosis

// Zeros of a separate table: free, also where no reading of it took part in the fit.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "emulator/replay.h"

namespace trunnion::diagnosis {

/// Device rows with a zero in common: those of each test and session of a laser or autocollimator,
/// and those of each axis's own encoder in each session.
std::vector<std::vector<std::size_t>> rows_of_zeros(const emulator::Replay& replay);

/// Subtracts from the rows of each zero their median, which a few spoiled readings do not move.
void free_medians(const std::vector<std::vector<std::size_t>>& zeros, Eigen::VectorXd& left_mm);

/// Subtracts from the rows of each zero the mean of its `used` ones, weighted by sigma.
void free_means(const std::vector<std::vector<std::size_t>>& zeros, const std::vector<bool>& used,
                const Eigen::VectorXd& sigma_mm, Eigen::VectorXd& left_mm);

}  // namespace trunnion::diagnosis

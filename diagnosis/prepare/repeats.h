// Rows that repeat each other, and the differences of their residuals (repeats.cpp;
// noise_estimate.cpp what they tell of noise and zeros).
#pragma once

#include <map>
#include <vector>

#include "diagnosis/prepare/noise.h"

namespace trunnion::diagnosis {

/// A sequence of values with the noise model of one device, in units of sigma, and the rows whose
/// directions define the shared part.
struct Stretch {
    std::vector<Eigen::Index> rows;
    Eigen::Index before = 0;  ///< the row that the first one repeats
    Eigen::VectorXd value;
};

/// Rows that are compared as a whole: the blocks; at targets single readings of those used, each
/// with the last one at the same target from the same side.
std::vector<NoiseBlock> compared_rows(const std::vector<NoiseBlock>& blocks,
                                      const std::vector<bool>& used);

/// Differences of rows that repeat each other, by device.
std::map<records::Device, std::vector<Stretch>> differences_of(
    const RepeatedRows& rows, const std::vector<NoiseBlock>& blocks,
    const Eigen::VectorXd& residual_mm, const Eigen::VectorXd& sigma_mm);

/// The cycles of a laser test, split where the zero jumps (diagnosis/prepare/cycle_zeros.h).
std::vector<Eigen::Index> cycles_between_jumps(const RepeatedRows& rows,
                                               const Eigen::VectorXd& residual_mm,
                                               const Eigen::VectorXd& sigma_mm);

/// The least deviation of differences of a device: its last digit, or arithmetic.
double least_scatter(const RepeatedRows& rows, const Eigen::VectorXd& sigma_mm,
                     records::Device device);

}  // namespace trunnion::diagnosis

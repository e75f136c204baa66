// Scatter of the zeroing of tests with a probe: in a fit it is noise that a test's rows share.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "emulator/replay.h"

namespace trunnion::identification {

/// Each test of sphere or touch rows (in each session) has a displacement of the workpiece of its
/// own: three independent numbers of one sigma, `zero` of [model] noise_um. With V = I + Z Z' the
/// covariance of rows divided by their sigmas, products with V^-1 count a test with many readings
/// for no more than its zero allows. Without the key V = I.
class ZeroScatter {
  public:
    /// `gradient`: derivatives of each device row.
    ZeroScatter(const setup::Setup& setup, const records::ReadingTable& table,
                const emulator::Replay& replay,
                const std::vector<kinematics::Perturbation>& gradient);

    /// left' V^-1 right. One row a device row, already multiplied by its `weight` (1 / sigma, mm).
    Eigen::MatrixXd product(const Eigen::MatrixXd& left, const Eigen::MatrixXd& right,
                            const Eigen::VectorXd& weight) const;

  private:
    struct Test {
        std::vector<Eigen::Index> rows;
        Eigen::MatrixX3d reading_mm;  ///< of each row, for one sigma along X, Y and Z of W
    };
    std::vector<Test> tests_;
};

}  // namespace trunnion::identification

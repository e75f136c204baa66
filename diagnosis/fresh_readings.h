// Simulated future readings: similar to the present ones, at other positions, speeds and times.
#pragma once

#include <optional>

#include "diagnosis/prepare/prepare.h"
#include "diagnosis/search/column_group.h"

namespace trunnion::diagnosis {

/// Positions of fresh readings, and the derivatives of all parameters there. Probe: rotary angles
/// between those of two measured poses, the stylus at the same position relative to the sphere.
/// Ballbar: positions between the samples, up to 1.5 times faster or slower, inclined where a
/// rotary axis turns. Times: within the session and up to a third beyond. Explanations that
/// coincide on the present readings (a ripple and its alias, a lag and a spike) differ on these.
class FreshReadings {
  public:
    FreshReadings(const Prepared& prepared, std::uint64_t seed);

    /// Rows of each pose or pass.
    const std::vector<NoiseBlock>& blocks() const { return blocks_; }
    std::size_t rows() const { return replay_->size(); }
    /// Derivatives with respect to the parameters of the base model, mm for one typical change.
    const Eigen::MatrixXd& base() const { return base_; }
    /// Columns of a cause, as columns_on() gives them for the present readings.
    Eigen::MatrixXd columns(const ColumnGroup& group) const {
        return columns_on(*replay_, gradient_, group);
    }

  private:
    std::optional<emulator::Replay> replay_;
    std::vector<NoiseBlock> blocks_;
    std::vector<kinematics::Perturbation> gradient_;
    Eigen::MatrixXd base_;  ///< with respect to the parameters of the base model
};

}  // namespace trunnion::diagnosis

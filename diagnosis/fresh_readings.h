// Readings that could be taken next: like those at hand, at other places, speeds and times.
#pragma once

#include <optional>

#include "diagnosis/column_group.h"
#include "diagnosis/noise.h"

namespace trunnion::diagnosis {

/// Where fresh readings would be taken, and what each parameter would change there. Poses of the
/// probe: rotary angles between those of two measured poses, the stylus at the same place beside
/// the sphere. Passes of the ballbar: at places between those sampled, up to 1.5 times faster or
/// slower, oblique where a rotary axis turns. At any time of the session and a third beyond. What
/// two explanations share on the readings at hand (a ripple and its alias, a lag and a spike) they
/// do not share here.
class FreshReadings {
  public:
    FreshReadings(const identification::BaseModel& base, const effects::Catalogue& catalogue,
                  const records::ReadingTable& table, const emulator::Replay& replay,
                  const std::vector<NoiseBlock>& blocks, std::uint64_t seed);

    /// Rows of each pose or pass.
    const std::vector<NoiseBlock>& blocks() const { return blocks_; }
    std::size_t rows() const { return replay_->size(); }
    /// Derivatives (mm for one typical change) by the parameters of the base model.
    const Eigen::MatrixXd& base() const { return base_; }
    /// Columns of a cause, as columns_on has them for the readings at hand.
    Eigen::MatrixXd columns(const ColumnGroup& group) const {
        return columns_on(*replay_, gradient_, group);
    }

  private:
    std::optional<emulator::Replay> replay_;
    std::vector<NoiseBlock> blocks_;
    std::vector<kinematics::Perturbation> gradient_;
    Eigen::MatrixXd base_;  ///< by the parameters of the base model
};

}  // namespace trunnion::diagnosis

// Readings that took no part in the fit: the loss of a model on blocks and on places left out.
#pragma once

#include "diagnosis/prepare.h"
#include "diagnosis/search.h"

namespace trunnion::diagnosis {

/// Mean of squared whitened readings left out, by block.
struct BlockLoss {
    std::vector<double> square, rows;
    double mean() const;
};
/// Paired t of the loss that `with` saves against `without`, over blocks that see any difference.
struct Saving {
    double t = 0.0, blocks = 0.0;
};
Saving saving_of(const BlockLoss& without, const BlockLoss& with);

/// Fits of set-up and members to all but one fold, for any choice of the members that predict.
class LeftOut {
  public:
    /// `group` of each row (blocks; negative: never left out), `fold` of each group. The members'
    /// variances are those of `model`.
    LeftOut(const Design& design, const Model& model, const Folds& folds,
            const std::vector<bool>& used);

    /// Positions of `fitted` take part in the fit, those of `predicting` also in the prediction.
    Eigen::VectorXd residual(const std::vector<bool>& fitted,
                             const std::vector<bool>& predicting) const;
    BlockLoss loss(const std::vector<bool>& fitted, const std::vector<bool>& predicting) const;

  private:
    std::vector<Eigen::Index> columns_of(const std::vector<bool>& members) const;

    Folds folds_;
    std::vector<bool> used_;
    Eigen::MatrixXd all_;               ///< set-up, then members, whitened
    Eigen::VectorXd data_, precision_;  ///< prior, over the noise
    Eigen::Index known_ = 0;
    std::vector<Eigen::Index> first_, size_;
    std::vector<std::vector<Eigen::Index>> test_;  ///< rows by fold
    std::vector<Eigen::MatrixXd> gram_;            ///< of all rows but the fold's
    std::vector<Eigen::VectorXd> product_;
};

/// Whole places of an axis left out together, its ends never: does a table hold between places?
Folds place_folds(const emulator::Replay& replay, const TableForm& table);

}  // namespace trunnion::diagnosis

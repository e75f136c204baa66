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
    LeftOut(Design& design, const Model& model, const Folds& folds, const std::vector<bool>& used);

    /// Other variances of the members that `fitted` marks, in their order.
    void retune(const std::vector<bool>& fitted, const estimation::Variances& variances);
    /// Members of `fitted` take part in the fit, those of `predicting` also in the prediction.
    Eigen::VectorXd residual(const std::vector<bool>& fitted,
                             const std::vector<bool>& predicting) const;
    BlockLoss loss(const std::vector<bool>& fitted, const std::vector<bool>& predicting) const;

  private:
    /// One fold: its rows, and the normal equations of all others.
    struct Fold {
        std::vector<Eigen::Index> rows;
        Eigen::MatrixXd out, gram;  ///< columns of its rows; products over all other rows
        Eigen::VectorXd data, product;
        /// With all members fitted: mean and covariance (over the noise), from which any smaller
        /// fit follows. Empty until asked for.
        mutable Eigen::MatrixXd covariance;
        mutable Eigen::VectorXd mean;
    };
    Eigen::VectorXd fit(const Fold& fold, const std::vector<bool>& fitted) const;
    std::vector<Eigen::Index> columns_of(const std::vector<bool>& members, bool known) const;

    Folds folds_;
    std::vector<bool> used_;
    Eigen::VectorXd precision_;  ///< prior, over the noise
    Eigen::Index known_ = 0;
    std::vector<Eigen::Index> first_, size_;
    std::vector<Fold> fold_;
};

/// Whole places of an axis left out together, its ends never: does a table hold between places?
Folds place_folds(const emulator::Replay& replay, const TableForm& table);

/// Passes over the same path left out together (whatever the feed and the way round), poses of
/// probes and targets one by one: does a model hold on paths that were not measured?
Folds path_folds(const std::vector<NoiseBlock>& blocks, const emulator::Replay& replay,
                 const std::vector<Axis>& axes);

}  // namespace trunnion::diagnosis

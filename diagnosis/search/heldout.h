// Cross-validation: loss of a model on left-out blocks and left-out positions.
#pragma once

#include <Eigen/Cholesky>
#include <map>
#include <utility>

#include "diagnosis/prepare/prepare.h"
#include "diagnosis/search/search.h"

namespace trunnion::diagnosis {

/// Sum of squared whitened left-out residuals, and number of rows, for each block.
struct BlockLoss {
    std::vector<double> square, rows;
    double mean() const;
};
/// Paired t statistic of the loss that `with` saves against `without`, over blocks with any
/// difference.
struct Saving {
    double t = 0.0, blocks = 0.0;
    double sum = 0.0, spread = 0.0;  ///< of all blocks together; its standard deviation
};
Saving saving_of(const BlockLoss& without, const BlockLoss& with);
/// The same with blocks that speak for the sum by more than four times the median size taken as so
/// many: a block that one model misses by far makes the sum large, not uncertain.
Saving steady_saving_of(const BlockLoss& without, const BlockLoss& with);

/// What is left out together, and which rows count.
struct LeftOutRows {
    const Folds& folds;
    const std::vector<bool>& used;
};

/// Columns of set-up and groups on the rows of each fold, with their products: computed once, for
/// all models that are compared on these folds.
class FoldColumns {
  public:
    FoldColumns(Design& design, const LeftOutRows& rows);

    Design& design() const { return design_; }
    const LeftOutRows& left_out() const { return left_out_; }
    const std::vector<std::vector<Eigen::Index>>& rows() const { return rows_; }  ///< of each fold
    /// Set-up and members side by side on the rows of a fold, and products of all with each other.
    Eigen::MatrixXd columns(std::size_t fold, const std::vector<std::size_t>& members);
    Eigen::MatrixXd gram(std::size_t fold, const std::vector<std::size_t>& members);

  private:
    using ByFold = std::vector<Eigen::MatrixXd>;
    const ByFold& of(std::size_t group);
    const ByFold& products(std::size_t first, std::size_t second);

    Design& design_;
    LeftOutRows left_out_;
    std::vector<std::vector<Eigen::Index>> rows_;
    std::map<std::size_t, ByFold> columns_;
    std::map<std::pair<std::size_t, std::size_t>, ByFold> products_;
};

/// Fits of set-up and members to all folds but one, for any selection of predicting members.
class LeftOut {
  public:
    /// `group`: block of each row (negative: never left out); `fold`: fold of each block. The
    /// members' variances are those of `model`.
    LeftOut(FoldColumns& columns, const Model& model);
    LeftOut(Design& design, const Model& model, const Folds& folds, const std::vector<bool>& used);

    /// Sets the variances of the members marked by `fitted`, in their order.
    void retune(const std::vector<bool>& fitted, const estimation::Variances& variances);
    /// Members of `fitted` are fitted; those of `predicting` also contribute to the prediction.
    Eigen::VectorXd residual(const std::vector<bool>& fitted,
                             const std::vector<bool>& predicting) const;
    BlockLoss loss(const std::vector<bool>& fitted, const std::vector<bool>& predicting) const;
    /// The same, but the set-up may differ in a fold as far as the other folds leave it open: where
    /// they tell nothing of the cup of a bar, its readings judge the members alone.
    BlockLoss loss_beside_set_up(const std::vector<bool>& fitted,
                                 const std::vector<bool>& predicting) const;
    /// Squared left-out residuals of all members, relative to what the other folds leave uncertain
    /// of them: chi-squared of as many degrees of freedom as rows, times the variance of the noise,
    /// when the model holds.
    double surprise() const;

  private:
    /// One fold: its rows, and the normal equations of all other rows.
    struct Fold {
        std::vector<Eigen::Index> rows;
        Eigen::MatrixXd out, gram;  ///< columns of its rows; products over all other rows
        Eigen::VectorXd data, product;
        /// With all members fitted: mean, and half of the covariance, R with R'R (divided by the
        /// noise variance), from which any smaller fit follows. Empty until needed.
        mutable Eigen::MatrixXd half;
        mutable Eigen::VectorXd mean;
    };
    Eigen::VectorXd fit(const Fold& fold, const std::vector<bool>& fitted) const;
    Eigen::MatrixXd information_on_set_up(const Fold& fold, const std::vector<bool>& fitted) const;
    BlockLoss loss_of(const Eigen::VectorXd& left) const;
    std::vector<Eigen::Index> columns_of(const std::vector<bool>& members, bool known) const;

    Folds folds_;
    std::vector<bool> used_;
    Eigen::VectorXd precision_;  ///< of the prior, relative to the noise
    Eigen::Index known_ = 0;
    std::vector<Eigen::Index> first_, size_;
    std::vector<Fold> fold_;
};

}  // namespace trunnion::diagnosis

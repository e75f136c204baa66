// The columns of all candidate effects: derivatives of the readings, whitened, with their Gram
// matrix.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "diagnosis/noise.h"
#include "identification/base_model.h"

namespace trunnion {

/// One effect with its keys fixed: a block of columns, each for one typical change.
struct Candidate {
    const Effect* effect = nullptr;
    std::vector<double> values;           ///< keys; linear parameters 0
    std::vector<std::size_t> parameters;  ///< of the effect, one for each column
    Eigen::Index first = 0;               ///< column of the Gram matrix
    Eigen::Index size() const { return static_cast<Eigen::Index>(parameters.size()); }
    double log_prior = 0.0;
    bool visible = true;
};

/// Gaussian belief about base and columns, in units of their typical size.
struct Posterior {
    Eigen::VectorXd mean;
    Eigen::MatrixXd half;  ///< L of the information matrix L L^T
    /// Standard normal numbers made into an error of the mean.
    Eigen::VectorXd spread(const Eigen::VectorXd& z) const {
        return half.triangularView<Eigen::Lower>().transpose().solve(z);
    }
};

/// Base columns first, then those of the candidates; each whitened. `data` is the whitened
/// residual.
class Design {
  public:
    Design(const Replay& replay, const BaseModel& base, const Whitener& whitener);

    /// Adds a candidate; returns its index. Parameters that cannot change any reading have no
    /// column; nor have those that `takes` (where given) refuses.
    std::size_t add(const Effect& effect, std::vector<double> keys, double log_prior,
                    const std::function<bool(const EffectParameter&)>& takes = {});
    /// Whitens everything anew, for another noise model or other row weights.
    void rewhiten(const Whitener& whitener);
    /// Works out Gram matrix and projections of what was added since.
    void update();

    const std::vector<Candidate>& candidates() const { return candidates_; }
    Eigen::Index base_count() const { return base_; }
    Eigen::Index rows() const { return data_.size(); }

    // With the base projected out (set-up free, calibrated values with their prior):
    const Eigen::MatrixXd& gram() const { return gram_; }        ///< of all candidate columns
    const Eigen::VectorXd& product() const { return product_; }  ///< columns . data
    double freedom() const { return static_cast<double>(rows()) - static_cast<double>(base_rank_); }

    const Eigen::MatrixXd& raw() const { return raw_; }  ///< unwhitened columns, base first, mm
    /// Solution for base and the given columns (candidate numbering), ridge 1 / (scale^2).
    Eigen::VectorXd solve(const std::vector<Eigen::Index>& columns, double scale) const;
    /// Covariance of that solution, same order.
    Eigen::MatrixXd covariance(const std::vector<Eigen::Index>& columns, double scale) const;
    /// Expected square (mm^2) of each row's prediction error from the fit's own uncertainty.
    Eigen::VectorXd fit_variance(const std::vector<Eigen::Index>& columns, double scale) const;
    /// Residual (mm) of all rows after base and columns are fitted.
    Eigen::VectorXd residual(const std::vector<Eigen::Index>& columns, double scale) const;
    /// Squares by which that fit departs from calibrated values, in their sigma.
    double calibration_square(const std::vector<Eigen::Index>& columns, double scale) const;
    double calibrated() const { return calibrated_; }  ///< base parameters with a known value
    /// Residual (mm) of the rows `test` after a fit to all the others, and the expected square of
    /// that fit's own error there.
    Eigen::VectorXd residual_without(const std::vector<Eigen::Index>& test,
                                     const std::vector<Eigen::Index>& columns, double scale,
                                     Eigen::VectorXd* fit_variance = nullptr) const;
    /// Directions of the base that the readings leave open by more than a typical size, orthonormal
    /// in units of it: columns.
    Eigen::MatrixXd open_base() const;
    /// The solution as a distribution.
    Posterior posterior(const std::vector<Eigen::Index>& columns, double scale) const;

  private:
    /// Normal equations of base and columns, with their priors.
    void normal_equations(const std::vector<Eigen::Index>& columns, double scale,
                          Eigen::MatrixXd& a, Eigen::VectorXd& b) const;
    std::vector<Eigen::Index> places(const std::vector<Eigen::Index>& columns) const;

    const Replay& replay_;
    const BaseModel& model_;
    const Whitener* whitener_;
    Eigen::Index base_ = 0, done_ = 0;
    int base_rank_ = 0;
    double calibrated_ = 0.0;
    Eigen::VectorXd precision_;  ///< prior of the base parameters, in units of their typical size
    Eigen::VectorXd known_;      ///< where that prior lies, from the fitted base
    Eigen::MatrixXd raw_, white_, full_;
    Eigen::VectorXd data_, cross_;
    std::vector<Candidate> candidates_;
    Eigen::MatrixXd gram_;
    Eigen::VectorXd product_;
};

bool has_keys(const Effect& effect);

/// Simpler forms of an effect, each a choice of its linear parameters: the textbook's form, a
/// straightness without slope, and single vectors where an effect has several (one artefact of
/// many).
std::vector<std::function<bool(const EffectParameter&)>> simpler_forms(const Effect& effect);

}  // namespace trunnion

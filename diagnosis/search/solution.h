// The solution of a model: set-up and members in their units, residuals, and the resulting setup.
#pragma once

#include "diagnosis/prepare/prepare.h"
#include "diagnosis/search/search.h"

namespace trunnion::diagnosis {

/// Gaussian posterior of set-up and members together, in typical sizes.
struct Solution {
    Eigen::VectorXd mean;                   ///< set-up first, then the members' columns
    Eigen::MatrixXd factor;                 ///< L, where the information is L L'
    Eigen::Index known = 0;                 ///< number of set-up quantities
    std::vector<Eigen::Index> first, size;  ///< of each member
    /// Transforms standard normal deviates into an error of the mean.
    Eigen::VectorXd spread(const Eigen::VectorXd& z) const;
    Eigen::MatrixXd covariance() const;
};
Solution solved(Design& design, const Model& model);

/// The same without changes between sessions: coefficients of the machine in the first session.
Solution without_changes(const Design& design, const Model& model, Solution solution);

/// Readings minus set-up and causes, mm; zeros of tests and drivers are not subtracted.
Eigen::VectorXd left_mm(const Prepared& prepared, const Design& design, const Model& model,
                        const Solution& solution);

/// Parameter values of an effect in their units; keys are unchanged.
std::vector<double> values_in(const ColumnGroup& group, const Eigen::VectorXd& coefficients);
/// Values of a table at its positions, direction after direction, mm or rad.
Eigen::VectorXd table_values(const ColumnGroup& group, const Eigen::VectorXd& coefficients);

/// The largest value of each member, in typical sizes of its effect (5 um or 40 urad of a table).
std::vector<double> usual_sizes(Design& design, const Model& model);

/// The base setup with all causes of the model added: the machine in the last session. `at_places`:
/// members whose table holds at its positions alone, and ripples whose values are known there
/// alone; empty: none.
setup::Setup setup_with(const Prepared& prepared, const Design& design, const Model& model,
                        const Solution& solution, const std::vector<bool>& at_places = {});

/// Readings minus simulation with the set-up alone, fitted by least squares, mm. (The base model is
/// robust: where readings are far from noise, its zeros may not lie in their middle.)
Eigen::VectorXd set_up_left_mm(const Prepared& prepared, Design& design);

/// Without the members added last, as long as the model cannot be computed: a search that was ended
/// early may leave variances that no search would keep.
Model computable(Design& design, const SearchSetting& setting, Model model);

}  // namespace trunnion::diagnosis

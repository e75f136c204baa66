// A model solved: set-up and members in their units, what it leaves, the setup that has it.
#pragma once

#include "diagnosis/prepare.h"
#include "diagnosis/search.h"

namespace trunnion::diagnosis {

/// Gaussian belief about set-up and members together, in typical sizes.
struct Solution {
    Eigen::VectorXd mean;                   ///< set-up first, then the members' columns
    Eigen::MatrixXd factor;                 ///< L of the information L L'
    Eigen::Index known = 0;                 ///< set-up quantities
    std::vector<Eigen::Index> first, size;  ///< of each member
    /// Standard normal numbers made into an error of the mean.
    Eigen::VectorXd spread(const Eigen::VectorXd& z) const;
    Eigen::MatrixXd covariance() const;
};
Solution solved(Design& design, const Model& model);

/// The same without what changes between sessions: coefficients of the machine of the first one.
Solution without_changes(const Design& design, const Model& model, Solution solution);

/// Readings less set-up and causes, mm; zeros of tests and drivers stay in.
Eigen::VectorXd left_mm(const Prepared& prepared, const Design& design, const Model& model,
                        const Solution& solution);
/// Columns (mm) of the set-up and of the causes among the members.
Eigen::MatrixXd fitted_mm(const Prepared& prepared, const Design& design, const Model& model);

/// Values of an effect's parameters in their units; keys as they are.
std::vector<double> values_in(const ColumnGroup& group, const Eigen::VectorXd& coefficients);
/// Values of a table at its places, direction after direction, mm or rad.
Eigen::VectorXd table_values(const ColumnGroup& group, const Eigen::VectorXd& coefficients);

/// The base setup with all causes of the model added: the machine of the last session.
setup::Setup setup_with(const Prepared& prepared, const Design& design, const Model& model,
                        const Solution& solution);

}  // namespace trunnion::diagnosis

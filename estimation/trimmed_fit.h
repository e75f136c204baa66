// Least trimmed squares: a linear fit that many spoiled rows cannot pull to themselves.
//
// Model       y = A x + e on whitened rows, of which up to a given part are anything at all.
// Method      the h rows of smallest squares, fitted again until they no longer change (Rousseeuw
//             and Van Driessen 2006), from a start that the caller gives and, of few rows, from
//             random subsets. Ranked least squares: unobservable directions stay 0.
// Repeatable  the subsets depend on the number of rows only.
// Failure     none. Without columns the data is the residual.
#pragma once

#include <Eigen/Core>

namespace trunnion::estimation {

/// Residual of all rows. `spoiled`: part of the rows that may be anything, 0 to 0.5; `start`: a
/// residual to begin with.
Eigen::VectorXd trimmed_residual(const Eigen::MatrixXd& columns, const Eigen::VectorXd& data,
                                 const Eigen::VectorXd& start, double spoiled);

}  // namespace trunnion::estimation

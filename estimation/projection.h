// Variance explained by columns beside other columns: the only projection of the project.
//
// Model       y = N a + A b + e, rows whitened (independent, variance 1). N: `known` columns with
//             arbitrary coefficients, A: columns under test.
// Symbols     Q: orthonormal basis of the columns of N, n x rank. "Beside N" means (I - Q Q').
// Rank        columns of N are scaled to length 1; directions smaller than 1e-8 of the largest are
//             rounding and are omitted. Zero columns of N have no effect.
// Failure     none. An empty N projects nothing out.
#pragma once

#include <Eigen/Core>

namespace trunnion::estimation {

class Projection {
  public:
    explicit Projection(Eigen::MatrixXd known);

    Eigen::Index rank() const { return basis_.cols(); }
    const Eigen::MatrixXd& basis() const { return basis_; }  ///< Q
    /// Q' m: the coordinates of the columns of `m` in N, rank x columns.
    Eigen::MatrixXd coordinates(const Eigen::MatrixXd& m) const { return basis_.transpose() * m; }
    Eigen::MatrixXd beside(const Eigen::MatrixXd& m) const { return m - basis_ * coordinates(m); }

  private:
    Eigen::MatrixXd basis_;
};

/// Reduction of the squared sum of `data` when `columns` are added to N in the fit: chi-squared
/// distributed with as many degrees of freedom as the columns have rank beside N. Directions count
/// when a step of 1 changes the readings by at least `threshold` sigma.
double explained_beside(const Projection& known, const Eigen::MatrixXd& columns,
                        const Eigen::VectorXd& data, double threshold = 1e-4);

}  // namespace trunnion::estimation

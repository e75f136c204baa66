// What columns explain beside other columns: the one projection of the project.
//
// Model       y = N a + A b + e, rows whitened (independent, variance 1). N: `known` columns with
//             any coefficients, A: columns under test.
// Symbols     Q: orthonormal basis of the columns of N, n x rank. "Beside N" means (I - Q Q').
// Rank        columns of N are scaled to length 1; directions smaller than 1e-8 of the largest are
//             rounding and are left out. A column of N that is zero counts for nothing.
// Fails       never; an empty N projects nothing out.
#pragma once

#include <Eigen/Core>

namespace trunnion::estimation {

class Projection {
  public:
    explicit Projection(Eigen::MatrixXd known);

    Eigen::Index rank() const { return basis_.cols(); }
    const Eigen::MatrixXd& basis() const { return basis_; }  ///< Q
    /// Q' m: the part of the columns of `m` that N can follow, rank x columns.
    Eigen::MatrixXd coordinates(const Eigen::MatrixXd& m) const { return basis_.transpose() * m; }
    Eigen::MatrixXd beside(const Eigen::MatrixXd& m) const { return m - basis_ * coordinates(m); }

  private:
    Eigen::MatrixXd basis_;
};

/// Fall of the squared sum of `data` when `columns` join N in the fit (chi-squared with as many
/// degrees of freedom as the columns have rank beside N). Columns count when a step of 1 moves the
/// readings by `threshold` sigma.
double explained_beside(const Projection& known, const Eigen::MatrixXd& columns,
                        const Eigen::VectorXd& data, double threshold = 1e-4);

}  // namespace trunnion::estimation

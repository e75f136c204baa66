// Linear least squares from normal equations, with the rank revealed and null directions named.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace trunnion {

/// Unknowns in units of their typical size, readings in units of their sigma: an entry of the
/// information matrix is then "how many sigma does a typical change make, squared".
struct LinearFit {
    Eigen::VectorXd value;                    ///< smallest solution where directions are unseen
    Eigen::MatrixXd covariance;               ///< of the seen directions
    Eigen::VectorXd sigma;                    ///< NaN for an unknown with an unseen part
    std::vector<Eigen::VectorXd> null_space;  ///< sparse basis, largest entry 1
};

/// A direction counts as unseen when a typical change along it moves all readings together by less
/// than `threshold` sigma.
LinearFit solve_ranked(const Eigen::MatrixXd& information, const Eigen::VectorXd& gradient,
                       double threshold = 0.05);

}  // namespace trunnion

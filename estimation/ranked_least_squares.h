// Linear least squares from normal equations; directions that no reading sees are named.
//
// Model       y = A x + e, e ~ N(0, 1): rows are readings over their sigma, columns are derivatives
//             for one typical change of an unknown. So x counts typical changes, and an entry of
//             the information matrix A'A is "how many sigma does a typical change make", squared.
// Rank        a direction v of x is not seen when a typical change along it moves all readings
//             together by less than `threshold` sigma: |A v| < threshold.
// Policy      the one regularisation of this project's fits: directions that are not seen stay as
//             they are (x has no part along them); all others are fitted without any ridge. Known
//             values with an uncertainty enter as further rows, never as a ridge.
// Fails       never. No unknown: everything is empty. All directions unseen: x is zero.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace trunnion::estimation {

/// Orthonormal directions of p unknowns: those that readings see, with their information, and the
/// k others.
struct Directions {
    Eigen::MatrixXd seen;         ///< p x (p - k)
    Eigen::VectorXd information;  ///< p - k, of the seen ones, rising
    Eigen::MatrixXd unseen;       ///< p x k

    /// p x p: the inverse of the information matrix over the seen directions.
    Eigen::MatrixXd inverse() const {
        return seen * information.cwiseInverse().asDiagonal() * seen.transpose();
    }
};
/// Directions with less information than `least`, or than `part` of the largest, are not seen. The
/// rounding of normal equations is about 1e-16 of the largest.
Directions directions_above(const Eigen::MatrixXd& information, double least, double part = 1e-13);
/// The `unseen` directions with the least information are not seen, whatever they have: for
/// symmetries that are exact at another place of a nonlinear model.
Directions directions_beside(const Eigen::MatrixXd& information, Eigen::Index unseen);

/// p unknowns, k of them (or combinations) not seen.
struct LinearFit {
    Eigen::VectorXd value;                    ///< p; the smallest of all solutions
    Eigen::MatrixXd covariance;               ///< p x p, of the seen directions
    Eigen::VectorXd sigma;                    ///< p; NaN for an unknown with an unseen part
    std::vector<Eigen::VectorXd> null_space;  ///< k sparse vectors of p entries, largest entry 1
};

/// `information` = A'A (p x p, symmetric), `gradient` = A'y (p).
LinearFit solve_ranked(const Eigen::MatrixXd& information, const Eigen::VectorXd& gradient,
                       double threshold = 0.05);

}  // namespace trunnion::estimation

// Linear least squares from normal equations; reports directions that the readings do not
// determine.
//
// Model       y = A x + e, e ~ N(0, 1): rows are readings divided by their sigma, columns are
//             derivatives with respect to unknowns in units of their typical change. So x counts
//             typical changes, and A'A contains squared signal-to-noise ratios of typical changes.
// Rank        a direction v of x is unobservable when a typical change along it moves all readings
//             together by less than `threshold` sigma: |A v| < threshold. Eigenvalues of A'A below
//             1e-13 of the largest are rounding and count as unobservable too.
// Policy      the only regularisation of the fits in this project: x has no component along
//             unobservable directions; all others are fitted without any ridge. Known values with
//             an uncertainty enter as additional rows, never as a ridge.
// Failure     none. Without unknowns everything is empty. If all directions are unobservable, x =
// 0.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace trunnion::estimation {

/// Orthonormal directions of p unknowns: the observable ones with their information, and the k
/// unobservable ones.
struct Directions {
    Eigen::MatrixXd seen;         ///< p x (p - k)
    Eigen::VectorXd information;  ///< p - k, of the observable directions, rising
    Eigen::MatrixXd unseen;       ///< p x k

    /// p x p: the inverse of the information matrix on the observable directions.
    Eigen::MatrixXd inverse() const {
        return seen * information.cwiseInverse().asDiagonal() * seen.transpose();
    }
};
/// Directions with less information than `least`, or than `part` of the largest, are unobservable.
/// Rounding of the normal equations is about 1e-16 of the largest.
Directions directions_above(const Eigen::MatrixXd& information, double least, double part = 1e-13);
/// The `unseen` directions with the least information are unobservable, whatever their information:
/// for symmetries that are exact at another point of a nonlinear model.
Directions directions_beside(const Eigen::MatrixXd& information, Eigen::Index unseen);

/// Threshold of the rank, in sigma, and the information that it stands for.
constexpr double unobservable = 0.05, unobservable_information = unobservable * unobservable;

/// p unknowns, k unobservable directions.
struct LinearFit {
    Eigen::VectorXd value;                    ///< p; the solution of smallest norm
    Eigen::MatrixXd covariance;               ///< p x p, without the unobservable directions
    Eigen::VectorXd sigma;                    ///< p; NaN for an unknown with an unobservable
                                              ///< component
    std::vector<Eigen::VectorXd> null_space;  ///< k sparse vectors of p entries, largest entry 1;
                                              ///< entries below 1e-3 are zero
    Eigen::MatrixXd unseen = {};              ///< p x k; the same directions, orthonormal
};

/// `information` = A'A (p x p, symmetric), `gradient` = A'y (p).
LinearFit solve_ranked(const Eigen::MatrixXd& information, const Eigen::VectorXd& gradient,
                       double threshold = unobservable);

/// y'A x of that solution: the squared data that it explains.
double explained(const Eigen::MatrixXd& information, const Eigen::VectorXd& gradient,
                 double threshold = unobservable);

}  // namespace trunnion::estimation

// Errors of any shape along an axis: knots, and smooth shapes between them.
//
// Model       E(q) = sum_j V_j(q) b_j, b ~ N(0, tau^2 I): a Matern-3/2 process of unit variance and
// a
//             given correlation length on knots, linear between them, less the polynomials or
//             harmonics that a textbook effect owns (orthogonal to them at the knots).
// Symbols     K knots at q_1 < ... < q_K; `shape` is K x columns, its columns are eigenvectors of
// the
//             knots' covariance times the root of the eigenvalue, largest first.
// Fails       never; fewer than two places: no knots, no shapes.
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

namespace trunnion::estimation {

/// Every distinct place (nearer than 1e-6 of the range is one place) while there are at most
/// `most`, else that many evenly over the range.
std::vector<double> knots_of(std::vector<double> places, std::size_t most);

/// The knot before q and the weight of the one after it: q = (1 - w) knot[k] + w knot[k + 1].
/// Beyond the ends the end knot has all weight. Needs two knots or more.
std::pair<Eigen::Index, double> place_between(const std::vector<double>& knots, double q);

/// Correlation lengths worth trying: 1/2, 1/4, 1/8, 1/16 of the range, none below 0.6 of the median
/// spacing of the knots.
std::vector<double> correlation_lengths(const std::vector<double>& knots);

/// Shapes of one length at the knots. `owned` (K x p): functions that the shapes must not hold.
/// At most `most` columns; shapes below 1e-4 of the largest variance are left out.
Eigen::MatrixXd smooth_shapes(const std::vector<double>& knots, double length,
                              const Eigen::MatrixXd& owned, Eigen::Index most);

/// 1, q, q^2, ... at the knots, q scaled to -1..1: K x orders.
Eigen::MatrixXd polynomials_at(const std::vector<double>& knots, int orders);

}  // namespace trunnion::estimation

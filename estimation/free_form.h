// Errors of any form along an axis: knots, and smooth functions between them.
//
// Model       E(q) = sum_j V_j(q) b_j, b ~ N(0, tau^2 I): a Matern-3/2 process of unit variance and
//             given correlation length on knots, linear between them, made orthogonal at the knots
//             to the polynomials or harmonics that belong to a textbook effect.
// Symbols     K knots at q_1 < ... < q_K; `shape` is K x columns: eigenvectors of the covariance of
//             the knots, times the square root of the eigenvalue, largest first.
// Failure     none. Fewer than two positions give no knots and no shapes.
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

namespace trunnion::estimation {

/// All distinct positions (closer than 1e-6 of the range counts as equal) if there are at most
/// `most`, else `most` positions evenly over the range.
std::vector<double> knots_of(std::vector<double> places, std::size_t most);

/// The knot before q and the weight of the next one: q = (1 - w) knot[k] + w knot[k + 1]. Beyond
/// the ends the end knot has all the weight. Requires two knots or more.
std::pair<Eigen::Index, double> place_between(const std::vector<double>& knots, double q);

/// Candidate correlation lengths: 1/2, 1/4, 1/8, 1/16 of the range, as far as they are at least 0.6
/// of the median knot spacing; of few knots, or where `each` may have a value of its own, this too,
/// if none is near it.
std::vector<double> correlation_lengths(const std::vector<double>& knots, bool each = false);

/// Shapes of one correlation length at the knots, K x columns. `owned` (K x p): functions to which
/// the shapes are made orthogonal. At most `most` columns; shapes with less than 1e-4 of the
/// largest variance are omitted.
Eigen::MatrixXd smooth_shapes(const std::vector<double>& knots, double length,
                              const Eigen::MatrixXd& owned, Eigen::Index most);

/// 1, q, q^2, ... at the knots, q scaled to -1..1: K x orders.
Eigen::MatrixXd polynomials_at(const std::vector<double>& knots, int orders);

}  // namespace trunnion::estimation

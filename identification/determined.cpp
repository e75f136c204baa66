#include "identification/determined.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "estimation/ranked_least_squares.h"

namespace trunnion::identification {
namespace {

/// Directions with more information have a sigma of a thirtieth of a typical size or less: their
/// derivative is no accident.
constexpr double weak_information = 1000.0;
/// Share of the machine in a direction below which the set-up would have to move far for it.
constexpr double least_machine_share = 0.1;

/// Squared part of a bend that no other direction follows.
double own_square(const estimation::Directions& d, Eigen::Index own, const Bend& bend) {
    const Eigen::VectorXd along = d.seen.transpose() * bend.product;
    double square = bend.square;
    for (Eigen::Index k = 0; k < along.size(); ++k)
        if (k != own) square -= along(k) * along(k) / d.information(k);
    return std::max(0.0, square);
}

}  // namespace

Eigen::MatrixXd curved_directions(const Eigen::MatrixXd& information,
                                  const std::function<Bend(const Eigen::VectorXd&)>& bend) {
    const estimation::Directions d =
        estimation::directions_above(information, estimation::unobservable_information);
    std::vector<Eigen::Index> curved;
    for (Eigen::Index k = 0; k < d.information.size() && d.information(k) < weak_information; ++k) {
        const Bend own = bend(d.seen.col(k));
        if (d.information(k) < own.off * std::sqrt(own_square(d, k, own))) curved.push_back(k);
    }
    if (curved.empty()) return Eigen::MatrixXd(information.rows(), 0);
    return d.seen(Eigen::all, curved);
}

Eigen::MatrixXd steps_beside(const Eigen::MatrixXd& unseen, const std::vector<bool>& of_machine) {
    const Eigen::Index p = unseen.rows();
    const Eigen::MatrixXd shared = Eigen::MatrixXd::Identity(p, p) - unseen * unseen.transpose();
    Eigen::MatrixXd machine = Eigen::MatrixXd::Zero(p, unseen.cols());
    for (Eigen::Index j = 0; j < p; ++j)
        if (of_machine[static_cast<std::size_t>(j)]) machine.row(j) = unseen.row(j);
    if (unseen.cols() == 0) return shared;
    // The step along `unseen` that leaves least of the machine's part.
    const estimation::Directions d = estimation::directions_above(
        machine.transpose() * machine, least_machine_share * least_machine_share);
    return shared - unseen * d.inverse() * machine.transpose() * shared;
}

}  // namespace trunnion::identification

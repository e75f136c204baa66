// What readings leave open stays as declared: directions of the unknowns that they do not
// determine, and steps without a share along these.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace trunnion::identification {

/// What the derivatives of a fit leave out: d is the change of the weighted readings by a step and
/// by its opposite, on average.
struct Bend {
    Eigen::VectorXd product;  ///< A'd, A the weighted columns
    double square = 0.0;      ///< d'd
    double off = 1.0;         ///< by how much the readings may be off along the direction, sigmas
};

/// Orthonormal directions (p x k, unknowns in typical sizes) that have a derivative only because
/// the point at which it was taken is a little beside one where it vanishes: the height of a sphere
/// touched near its equator. There readings that are off make a step across which the derivative
/// changes by its own size; such a step says nothing, and may be of many millimetres. `bend`: of a
/// typical step along a direction. What other directions can follow of it does not count.
/// Directions of no information are not among them.
Eigen::MatrixXd curved_directions(const Eigen::MatrixXd& information,
                                  const std::function<Bend(const Eigen::VectorXd&)>& bend);

/// p x p: takes from a step what lies along `unseen` (orthonormal columns). What the readings
/// determine only as a sum of the machine and of the set-up then moves the set-up: that was placed
/// by hand for these readings, and the machine stays as declared. A sum within the machine is
/// shared by typical sizes.
Eigen::MatrixXd steps_beside(const Eigen::MatrixXd& unseen, const std::vector<bool>& of_machine);

}  // namespace trunnion::identification

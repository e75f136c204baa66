// Groups of columns with one variance each: restricted likelihood, gain of one group, solution.
//
// Model       y = N a + sum_g A_g b_g + e on whitened rows; a free, b_g ~ N(0, tau_g^2 I),
//             e ~ N(0, nu^2 I). Columns are scaled so that tau = 1 is the usual size of the effect.
// Symbols     J: columns of all members side by side (m of them); G = A_J'A_J and h = A_J'y after
//             projecting out N; D = diag(tau); n' = n - rank N.
// Likelihood  restricted (REML, a eliminated), relative to no members and nu = 1:
//               L = -1/2 [n' ln nu^2 + ln|I + D G D / nu^2| + (y'y - z'z / nu^2) / nu^2 - y'y]
//                   - 1/2 ((ln nu - l0) / s)^2,      z = chol(I + D G D / nu^2)^-1 D h
//             The last term is the prior of the noise.
// Assumes     independent rows of variance nu^2, and groups independent of each other. Correlated
//             noise must be whitened and outliers removed beforehand.
// Failure     none. A group with tau = 0 has no effect. Columns that are zero or linearly dependent
//             are harmless, since every direction has a prior.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <array>
#include <vector>

namespace trunnion::estimation {

/// Products of the members' columns, with the known columns projected out.
struct GroupEquations {
    Eigen::MatrixXd gram;            ///< G, m x m
    Eigen::VectorXd product;         ///< h, m
    double square = 0.0;             ///< y'y
    double rows = 0.0;               ///< n'
    std::vector<Eigen::Index> size;  ///< columns of each group, in order

    std::size_t groups() const { return size.size(); }
    Eigen::Index first(std::size_t group) const;
};

/// Prior of ln nu: mean l0 and standard deviation s; nu is at least `least`.
struct NoisePrior {
    double log_mean = 0.0;
    double spread = 0.3;
    double least = 0.0;
};

struct Variances {
    std::vector<double> tau;  ///< of each group
    double nu = 1.0;
    bool operator==(const Variances&) const = default;
};
/// The same with sizes that are not too small for the inverse of a covariance.
Variances not_absent(Variances variances);

double restricted_likelihood(const GroupEquations& equations, const Variances& variances,
                             const NoisePrior& prior);

/// One group alone: the information about b and its product with the data, divided by nu^2.
struct GroupInformation {
    Eigen::MatrixXd information;  ///< k x k
    Eigen::VectorXd product;      ///< k
};

/// Members with their variances: the factorisation L L' = I + D G D / nu^2, which is all that the
/// likelihood needs.
struct FactoredMembers {
    FactoredMembers(const GroupEquations& equations, const Variances& variances);
    Eigen::VectorXd mean() const;  ///< of b, m entries

    double nu = 1.0;
    Eigen::VectorXd tau;           ///< of each column: the diagonal of D
    Eigen::MatrixXd factor;        ///< L, padded (estimation/lower_triangle.h)
    Eigen::VectorXd z;             ///< L^-1 D h
    double log_determinant = 0.0;  ///< of I + D G D / nu^2
};

/// The same with the inverse of L, for evaluating what the members leave to another group.
class GivenMembers {
  public:
    explicit GivenMembers(FactoredMembers factored);
    GivenMembers(const GroupEquations& equations, const Variances& variances)
        : GivenMembers(FactoredMembers(equations, variances)) {}

    /// Information of a group after the members. `cross` = A_J'A_g (m x k), `gram` = A_g'A_g,
    /// `product` = A_g'y, all beside N.
    GroupInformation leave(const Eigen::MatrixXd& cross, const Eigen::MatrixXd& gram,
                           const Eigen::VectorXd& product) const;
    /// The same in two steps; the first one may be used for many groups side by side: L^-1 D cross
    /// / nu^2.
    Eigen::MatrixXd taken(const Eigen::MatrixXd& cross) const;
    GroupInformation leave_beside(const Eigen::Ref<const Eigen::MatrixXd>& taken,
                                  const Eigen::MatrixXd& gram,
                                  const Eigen::VectorXd& product) const;
    const Eigen::VectorXd& mean() const { return mean_; }  ///< of b, m entries
    Eigen::MatrixXd covariance() const;                    ///< of b: D (L L')^-1 D
    const Eigen::MatrixXd& half() const { return half_; }  ///< R = L^-1 D: R'R = covariance
    double nu() const { return nu_; }

  private:
    double nu_;
    Eigen::MatrixXd half_;
    Eigen::VectorXd z_, mean_;
};

/// The information of a group after Householder reduction: tridiagonal in its own basis, so that
/// the likelihood for any size costs one pass along the diagonal. May be used for many products.
class ReducedGroup {
  public:
    explicit ReducedGroup(const Eigen::MatrixXd& information);
    /// A product in that basis.
    Eigen::VectorXd turned(Eigen::VectorXd product) const;
    using Eight = std::array<double, 8>;
    /// The same as gain_at for eight sizes in ascending order, for `factor` times the information.
    Eight gains(const Eigen::VectorXd& turned, double factor, const Eight& tau) const;

  private:
    Eigen::VectorXd diagonal_, beside_;
    Eigen::MatrixXd basis_;
};

/// Gain of the log likelihood by one group.
struct GroupGain {
    double mean = 0.0;  ///< log of the mean likelihood ratio over 26 sizes 0.01..1000 (log grid)
    double best = 0.0;  ///< gain at the best size
    double tau = 0.0;   ///< the best size
};
/// At one size: sum_i -1/2 ln(1 + tau^2 l_i) + 1/2 tau^2 q_i^2 / (1 + tau^2 l_i), with l_i the
/// eigenvalues of the information and q_i the product in its eigenvectors.
double gain_at(const GroupInformation& group, double tau);
GroupGain group_gain(const GroupInformation& group);
/// The same for `factor` times a reduced information. Members reduce the information and thereby
/// increase the true gain, so the full information gives a lower bound.
GroupGain group_gain(const ReducedGroup& group, const Eigen::VectorXd& product, double factor);
/// Of this gain the mean alone.
double mean_gain(const ReducedGroup& group, const Eigen::VectorXd& product, double factor);

/// Each group beside all the others at their variances, from one factorisation: with P the block of
/// the covariance that belongs to group g, its information alone is P^-1 - I / tau_g^2.
std::vector<GroupInformation> each_beside_others(const GroupEquations& equations,
                                                 const Variances& variances);
/// The same with the factorisation of members that are not absent.
std::vector<GroupInformation> each_beside_others(const GroupEquations& equations,
                                                 const std::vector<double>& tau,
                                                 const GivenMembers& all);

struct BestVariances {
    Variances variances;
    double likelihood = 0.0;  ///< restricted_likelihood() at these variances
    Eigen::VectorXd mean;     ///< of b at these variances, m entries
};
/// Variances that maximise the restricted likelihood, from `start`. In each sweep every group gets
/// its best size beside the others at their previous sizes, then the noise is estimated from the
/// remainder. A sweep that lowers the likelihood is halved (in logarithms). Ends when a sweep gains
/// less than 0.01, or after `sweeps` sweeps if the last gained less than 10: of a large effect in
/// little noise each sweep finds a part.
BestVariances maximise_likelihood(const GroupEquations& equations, Variances start,
                                  const NoisePrior& prior, int sweeps);

}  // namespace trunnion::estimation

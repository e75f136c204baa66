#include "estimation/variance_groups.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "estimation/lower_triangle.h"

namespace trunnion::estimation {
namespace {

constexpr int sizes = 26;
constexpr double smallest = 0.01, largest = 1000.0;

double size_at(double step) {
    return smallest * std::pow(largest / smallest, step / (sizes - 1));
}

/// A reduced group with one product: gain as a function of the size.
struct Chain {
    const ReducedGroup& group;
    Eigen::VectorXd turned;
    double factor;
    double gain(double tau) const { return group.gain(turned, factor, tau); }
};

struct Peak {
    double step, gain;
};

/// Refines the best size of the grid by two parabolas in the logarithm of the size.
Peak refined(const Chain& chain, Peak at) {
    for (const double h : {1.0, 0.25}) {
        const double left = chain.gain(size_at(at.step - h)),
                     right = chain.gain(size_at(at.step + h));
        const double bend = left - 2.0 * at.gain + right;
        if (bend >= 0.0) break;
        const double step = at.step + std::clamp(0.5 * h * (left - right) / bend, -h, h);
        const double gain = chain.gain(size_at(step));
        if (gain > at.gain) at = {step, gain};
    }
    return at;
}

Eigen::VectorXd by_column(const GroupEquations& equations, const Variances& variances) {
    Eigen::VectorXd tau(equations.product.size());
    Eigen::Index at = 0;
    for (std::size_t g = 0; g < equations.groups(); ++g) {
        tau.segment(at, equations.size[g]).setConstant(variances.tau[g]);
        at += equations.size[g];
    }
    return tau;
}

/// I + D G D / nu^2, padded by a unit matrix.
Eigen::MatrixXd scaled_gram(const GroupEquations& equations, const Eigen::VectorXd& tau,
                            double nu) {
    const Eigen::Index own = tau.size(), rows = padded_rows(own);
    Eigen::MatrixXd m = Eigen::MatrixXd::Zero(rows, rows);
    m.topLeftCorner(own, own) = tau.asDiagonal() * equations.gram * tau.asDiagonal() / (nu * nu);
    m.diagonal().array() += 1.0;
    return m;
}

constexpr double least_size = 1e-3;  ///< groups below this size count as absent

/// Standard deviation that maximises the likelihood of a remainder `square` with `freedom` degrees
/// of freedom and the prior: Newton's method for its logarithm.
double best_noise(double square, double freedom, const NoisePrior& prior) {
    const double weight = 1.0 / (prior.spread * prior.spread);
    double log_nu = 0.5 * std::log(std::max(1e-12, square) / std::max(1.0, freedom));
    for (int k = 0; k < 50; ++k) {
        const double ratio = square * std::exp(-2.0 * log_nu);
        const double slope = ratio - freedom - weight * (log_nu - prior.log_mean);
        const double step = slope / (2.0 * ratio + weight);
        log_nu += std::clamp(step, -0.5, 0.5);
        if (std::abs(step) < 1e-9) break;
    }
    return std::exp(log_nu);
}

/// Noise estimated from the remainder with the variances of the groups fixed.
double remaining_noise(const GroupEquations& equations, const GivenMembers& given,
                       const NoisePrior& prior) {
    if (equations.product.size() == 0) return best_noise(equations.square, equations.rows, prior);
    const Eigen::VectorXd mean = given.mean();
    const double left =
        equations.square - 2.0 * mean.dot(equations.product) + mean.dot(equations.gram * mean);
    return best_noise(std::max(0.0, left), equations.rows - given.freedom_used(), prior);
}

double likelihood_of(const GroupEquations& equations, const FactoredMembers& members,
                     const NoisePrior& prior) {
    const double nu2 = members.nu * members.nu,
                 off = (std::log(members.nu) - prior.log_mean) / prior.spread;
    return -0.5 * (equations.rows * std::log(nu2) + members.log_determinant +
                   (equations.square - members.z.squaredNorm() / nu2) / nu2 - equations.square) -
           0.5 * off * off;
}

/// Variances with their factorisation.
struct Step {
    Variances variances;
    FactoredMembers members;
    double likelihood;
    Step(const GroupEquations& equations, Variances v, const NoisePrior& prior)
        : variances(std::move(v)),
          members(equations, variances),
          likelihood(likelihood_of(equations, members, prior)) {}
};

std::vector<GroupInformation> each_beside(const GroupEquations& equations,
                                          const std::vector<double>& tau, const GivenMembers& all) {
    std::vector<GroupInformation> list;
    const Eigen::VectorXd mean = all.mean();
    for (std::size_t g = 0; g < equations.groups(); ++g) {
        const Eigen::Index first = equations.first(g), count = equations.size[g];
        // R is lower triangular: the rows above the group's first row are zero in its columns.
        const auto own = all.half().block(first, first, all.half().rows() - first, count);
        const Eigen::LLT<Eigen::MatrixXd> covariance(own.transpose() * own);
        GroupInformation alone;
        alone.information = covariance.solve(Eigen::MatrixXd::Identity(count, count));
        alone.product = covariance.solve(mean.segment(first, count));
        alone.information.diagonal().array() -= 1.0 / (tau[g] * tau[g]);
        list.push_back(std::move(alone));
    }
    return list;
}

Variances one_sweep(const GroupEquations& equations, const Step& from, const NoisePrior& prior) {
    Variances next = from.variances;
    const auto groups = each_beside(equations, from.variances.tau, GivenMembers(from.members));
    for (std::size_t g = 0; g < groups.size(); ++g) next.tau[g] = group_gain(groups[g]).tau;
    next.nu = remaining_noise(equations, GivenMembers(equations, next), prior);
    return next;
}

Variances not_absent(Variances variances) {
    for (double& tau : variances.tau) tau = std::max(tau, least_size);
    return variances;
}

Variances between(const Variances& a, Variances b) {
    for (std::size_t g = 0; g < a.tau.size(); ++g)
        b.tau[g] = std::sqrt(std::max(a.tau[g], least_size) * b.tau[g]);
    b.nu = std::sqrt(a.nu * b.nu);
    return b;
}

}  // namespace

Eigen::Index GroupEquations::first(std::size_t group) const {
    return std::accumulate(size.begin(), size.begin() + static_cast<long>(group), Eigen::Index{0});
}

double restricted_likelihood(const GroupEquations& equations, const Variances& variances,
                             const NoisePrior& prior) {
    return likelihood_of(equations, FactoredMembers(equations, variances), prior);
}

FactoredMembers::FactoredMembers(const GroupEquations& equations, const Variances& variances)
    : nu(variances.nu), tau(by_column(equations, variances)) {
    if (tau.size() == 0) return;
    factor = scaled_gram(equations, tau, nu);
    factor_in_place(factor);
    log_determinant = 2.0 * factor.diagonal().array().log().sum();
    z = tau.cwiseProduct(equations.product);
    factor.topLeftCorner(z.size(), z.size()).triangularView<Eigen::Lower>().solveInPlace(z);
}

GivenMembers::GivenMembers(FactoredMembers factored) : nu_(factored.nu), z_(std::move(factored.z)) {
    const Eigen::VectorXd& tau = factored.tau;
    if (tau.size() == 0) return;
    half_ = inverse_of_lower(factored.factor).topLeftCorner(tau.size(), tau.size());
    used_ = static_cast<double>(tau.size()) - half_.squaredNorm();
    for (Eigen::Index k = 0; k < tau.size(); ++k) half_.col(k) *= tau(k);
}

Eigen::MatrixXd GivenMembers::taken(const Eigen::MatrixXd& cross) const {
    // Without rows or columns Eigen would multiply by way of a null pointer.
    if (half_.size() == 0 || cross.cols() == 0) return Eigen::MatrixXd(half_.rows(), cross.cols());
    Eigen::MatrixXd t = half_.triangularView<Eigen::Lower>() * cross;
    return t / (nu_ * nu_);
}

GroupInformation GivenMembers::leave_beside(const Eigen::Ref<const Eigen::MatrixXd>& taken,
                                            const Eigen::MatrixXd& gram,
                                            const Eigen::VectorXd& product) const {
    const double nu2 = nu_ * nu_;
    GroupInformation left{gram / nu2, product / nu2};
    if (half_.size() == 0) return left;
    left.information.noalias() -= taken.transpose() * taken;
    left.product.noalias() -= taken.transpose() * z_ / nu2;
    return left;
}

GroupInformation GivenMembers::leave(const Eigen::MatrixXd& cross, const Eigen::MatrixXd& gram,
                                     const Eigen::VectorXd& product) const {
    return leave_beside(taken(cross), gram, product);
}

Eigen::VectorXd GivenMembers::mean() const {
    if (half_.size() == 0) return {};
    return half_.triangularView<Eigen::Lower>().transpose() * z_ / (nu_ * nu_);
}

Eigen::MatrixXd GivenMembers::covariance() const {
    return half_.transpose() * half_;
}

ReducedGroup::ReducedGroup(const Eigen::MatrixXd& information) : diagonal_(information.diagonal()) {
    if (information.rows() < 2) return;
    const Eigen::Tridiagonalization<Eigen::MatrixXd> reduced(information);
    diagonal_ = reduced.diagonal();
    beside_ = reduced.subDiagonal();
    basis_ = reduced.matrixQ();
}

Eigen::VectorXd ReducedGroup::turned(Eigen::VectorXd product) const {
    if (basis_.size() == 0) return product;
    return basis_.transpose() * product;
}

double ReducedGroup::gain(const Eigen::VectorXd& turned, double factor, double tau) const {
    const double t2 = tau * tau, own = t2 * factor;
    double quadratic = 0.0, log_det = 0.0, product = 1.0, pivot = 1.0, forward = 0.0;
    for (Eigen::Index i = 0; i < diagonal_.size(); ++i) {
        const double side = i > 0 ? own * beside_(i - 1) : 0.0, part = side / pivot;
        forward = turned(i) - part * forward;
        // The exact pivots of I + a positive semidefinite matrix are never below 1.
        pivot = std::max(1.0, 1.0 + own * diagonal_(i) - part * side);
        quadratic += forward * forward / pivot;
        product *= pivot;
        if (product < 1e150) continue;
        log_det += std::log(product);
        product = 1.0;
    }
    return 0.5 * (t2 * quadratic - log_det - std::log(product));
}

double gain_at(const GroupInformation& group, double tau) {
    const ReducedGroup reduced(group.information);
    return reduced.gain(reduced.turned(group.product), 1.0, tau);
}

GroupGain group_gain(const GroupInformation& group) {
    return group_gain(ReducedGroup(group.information), group.product, 1.0);
}

GroupGain group_gain(const ReducedGroup& group, const Eigen::VectorXd& product, double factor) {
    const Chain chain{group, group.turned(product), factor};
    std::array<double, sizes> gain{};
    for (int k = 0; k < sizes; ++k) gain[static_cast<std::size_t>(k)] = chain.gain(size_at(k));
    const auto best = std::max_element(gain.begin(), gain.end());
    double sum = 0.0;
    for (const double g : gain) sum += std::exp(g - *best);
    const Peak peak = refined(chain, {static_cast<double>(best - gain.begin()), *best});
    return {*best + std::log(sum / sizes), peak.gain, size_at(peak.step)};
}

std::vector<GroupInformation> each_beside_others(const GroupEquations& equations,
                                                 const Variances& variances) {
    const Variances given = not_absent(variances);
    return each_beside(equations, given.tau, GivenMembers(equations, given));
}

BestVariances maximise_likelihood(const GroupEquations& equations, Variances start,
                                  const NoisePrior& prior, int sweeps) {
    Step now(equations, not_absent(std::move(start)), prior);
    for (int k = 0; k < sweeps; ++k) {
        Step next(equations, one_sweep(equations, now, prior), prior);
        // Written so that a likelihood that cannot be computed (NaN) is a worse one.
        const auto worse = [&] { return !(next.likelihood >= now.likelihood); };
        for (int halved = 0; worse() && halved < 4; ++halved)
            next = Step(equations, between(now.variances, std::move(next.variances)), prior);
        if (worse()) break;
        const double gained = next.likelihood - now.likelihood;
        now = std::move(next);
        if (gained < 0.01) break;
    }
    return {std::move(now.variances), now.likelihood};
}

}  // namespace trunnion::estimation

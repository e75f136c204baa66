#include "estimation/variance_groups.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace trunnion::estimation {
namespace {

constexpr int sizes = 26;
constexpr double smallest = 0.01, largest = 1000.0;

/// A group in the eigenvectors of its information.
struct Spectrum {
    Eigen::ArrayXd value, product_square;

    explicit Spectrum(const GroupInformation& group) {
        if (group.product.size() == 1) {
            value = group.information.diagonal().array().max(0.0);
            product_square = group.product.array().square();
            return;
        }
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(group.information);
        value = eigen.eigenvalues().array().max(0.0);
        product_square = (eigen.eigenvectors().transpose() * group.product).array().square();
    }
    double gain(double tau) const {
        const Eigen::ArrayXd grown = 1.0 + tau * tau * value;
        return 0.5 * (tau * tau * product_square / grown - grown.log()).sum();
    }
};

double size_at(double step) {
    return smallest * std::pow(largest / smallest, step / (sizes - 1));
}

/// The best size between the neighbours of the grid's best, by golden section in its logarithm.
double refined(const Spectrum& spectrum, int at) {
    constexpr double golden = 0.6180339887498949;
    double low = at - 1.0, high = at + 1.0;
    for (int k = 0; k < 9; ++k) {
        const double a = high - golden * (high - low), b = low + golden * (high - low);
        (spectrum.gain(size_at(a)) > spectrum.gain(size_at(b)) ? high : low) =
            spectrum.gain(size_at(a)) > spectrum.gain(size_at(b)) ? b : a;
    }
    return size_at(0.5 * (low + high));
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

Eigen::MatrixXd scaled_gram(const GroupEquations& equations, const Eigen::VectorXd& tau,
                            double nu) {
    Eigen::MatrixXd m = tau.asDiagonal() * equations.gram * tau.asDiagonal() / (nu * nu);
    m.diagonal().array() += 1.0;
    return m;
}

constexpr double least_size = 1e-3;  ///< below it a group is as good as absent

/// Standard deviation of a remainder `square` with `freedom`, beside what is known beforehand:
/// Newton's method for its logarithm.
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

/// The noise that the remainder asks for, all variances of groups as they are.
double remaining_noise(const GroupEquations& equations, const Variances& variances,
                       const NoisePrior& prior) {
    if (equations.product.size() == 0) return best_noise(equations.square, equations.rows, prior);
    const GivenMembers given(equations, variances);
    const Eigen::VectorXd tau = by_column(equations, variances), mean = given.mean();
    const Eigen::MatrixXd half = given.half() * tau.cwiseInverse().asDiagonal();
    const double used = static_cast<double>(tau.size()) - half.squaredNorm();
    const double left =
        equations.square - 2.0 * mean.dot(equations.product) + mean.dot(equations.gram * mean);
    return best_noise(std::max(0.0, left), equations.rows - used, prior);
}

Variances one_sweep(const GroupEquations& equations, Variances variances, const NoisePrior& prior) {
    for (double& tau : variances.tau) tau = std::max(tau, least_size);
    const std::vector<GroupInformation> groups = each_beside_others(equations, variances);
    for (std::size_t g = 0; g < groups.size(); ++g) variances.tau[g] = group_gain(groups[g]).tau;
    variances.nu = remaining_noise(equations, variances, prior);
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
    const double nu2 = variances.nu * variances.nu;
    double log_det = 0.0, fitted = 0.0;
    if (equations.product.size() > 0) {
        const Eigen::VectorXd tau = by_column(equations, variances);
        const Eigen::LLT<Eigen::MatrixXd> llt(scaled_gram(equations, tau, variances.nu));
        log_det = 2.0 * llt.matrixLLT().diagonal().array().log().sum();
        fitted = llt.matrixL().solve(tau.cwiseProduct(equations.product)).squaredNorm() / nu2;
    }
    const double off = (std::log(variances.nu) - prior.log_mean) / prior.spread;
    return -0.5 * (equations.rows * std::log(nu2) + log_det + (equations.square - fitted) / nu2 -
                   equations.square) -
           0.5 * off * off;
}

GivenMembers::GivenMembers(const GroupEquations& equations, const Variances& variances)
    : tau_(by_column(equations, variances)),
      nu_(variances.nu),
      factor_(scaled_gram(equations, tau_, variances.nu)),
      z_(factor_.matrixL().solve(tau_.cwiseProduct(equations.product))) {}

GroupInformation GivenMembers::leave(const Eigen::MatrixXd& cross, const Eigen::MatrixXd& gram,
                                     const Eigen::VectorXd& product) const {
    const double nu2 = nu_ * nu_;
    GroupInformation left{gram / nu2, product / nu2};
    if (tau_.size() == 0) return left;
    const Eigen::MatrixXd t = factor_.matrixL().solve(tau_.asDiagonal() * cross) / nu2;
    left.information.noalias() -= t.transpose() * t;
    left.product.noalias() -= t.transpose() * z_ / nu2;
    return left;
}

Eigen::VectorXd GivenMembers::mean() const {
    return tau_.cwiseProduct(factor_.matrixL().transpose().solve(z_)) / (nu_ * nu_);
}

Eigen::MatrixXd GivenMembers::half() const {
    return factor_.matrixL().solve(Eigen::MatrixXd(tau_.asDiagonal()));
}

Eigen::MatrixXd GivenMembers::covariance() const {
    const Eigen::MatrixXd r = half();
    return r.transpose() * r;
}

double gain_at(const GroupInformation& group, double tau) {
    return Spectrum(group).gain(tau);
}

GroupGain group_gain(const GroupInformation& group) {
    const Spectrum spectrum(group);
    std::array<double, sizes> gain{};
    int best = 0;
    for (int k = 0; k < sizes; ++k) {
        gain[static_cast<std::size_t>(k)] = spectrum.gain(size_at(k));
        if (gain[static_cast<std::size_t>(k)] > gain[static_cast<std::size_t>(best)]) best = k;
    }
    GroupGain result;
    const double most = gain[static_cast<std::size_t>(best)];
    double sum = 0.0;
    for (const double g : gain) sum += std::exp(g - most);
    result.mean = most + std::log(sum / sizes);
    result.tau = refined(spectrum, best);
    result.best = spectrum.gain(result.tau);
    return result;
}

std::vector<GroupInformation> each_beside_others(const GroupEquations& equations,
                                                 const Variances& variances) {
    std::vector<GroupInformation> list;
    if (equations.groups() == 0) return list;
    Variances given = variances;
    for (double& tau : given.tau) tau = std::max(tau, least_size);
    const GivenMembers all(equations, given);
    const Eigen::MatrixXd half = all.half();
    const Eigen::VectorXd mean = all.mean();
    for (std::size_t g = 0; g < equations.groups(); ++g) {
        const Eigen::Index first = equations.first(g), count = equations.size[g];
        const auto own = half.middleCols(first, count);
        const Eigen::LLT<Eigen::MatrixXd> covariance(own.transpose() * own);
        GroupInformation alone;
        alone.information = covariance.solve(Eigen::MatrixXd::Identity(count, count));
        alone.product = covariance.solve(mean.segment(first, count));
        alone.information.diagonal().array() -= 1.0 / (given.tau[g] * given.tau[g]);
        list.push_back(std::move(alone));
    }
    return list;
}

Variances maximise_likelihood(const GroupEquations& equations, Variances start,
                              const NoisePrior& prior, int sweeps) {
    double before = restricted_likelihood(equations, start, prior);
    for (int k = 0; k < sweeps; ++k) {
        Variances next = one_sweep(equations, start, prior);
        double now = restricted_likelihood(equations, next, prior);
        for (int halved = 0; now < before && halved < 4; ++halved) {
            next = between(start, std::move(next));
            now = restricted_likelihood(equations, next, prior);
        }
        if (now < before) break;
        start = std::move(next);
        if (now - before < 0.01) break;
        before = now;
    }
    return start;
}

}  // namespace trunnion::estimation

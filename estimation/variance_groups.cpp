#include "estimation/variance_groups.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace trunnion {
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

std::vector<Eigen::Index> all_but(const GroupEquations& equations, std::size_t group) {
    std::vector<Eigen::Index> columns;
    const Eigen::Index from = equations.first(group), to = from + equations.size[group];
    for (Eigen::Index k = 0; k < equations.product.size(); ++k)
        if (k < from || k >= to) columns.push_back(k);
    return columns;
}

/// The size of one group that serves best beside all others.
double best_size(const GroupEquations& equations, const Variances& variances, std::size_t group) {
    const std::vector<Eigen::Index> others = all_but(equations, group);
    GroupEquations rest{equations.gram(others, others), equations.product(others), equations.square,
                        equations.rows, equations.size};
    rest.size.erase(rest.size.begin() + static_cast<long>(group));
    Variances given = variances;
    given.tau.erase(given.tau.begin() + static_cast<long>(group));
    const Eigen::Index from = equations.first(group), count = equations.size[group];
    const auto own = Eigen::seqN(from, count);
    return group_gain(GivenMembers(rest, given)
                          .leave(equations.gram(others, own), equations.gram(own, own),
                                 equations.product(own)))
        .tau;
}

/// A wide bracket first: the noise may be far from what was stated.
double best_noise(const GroupEquations& equations, Variances variances, const NoisePrior& prior) {
    const auto value = [&](double log_nu) {
        variances.nu = std::exp(log_nu);
        return restricted_likelihood(equations, variances, prior);
    };
    double at = std::log(variances.nu), most = value(at);
    for (const double step : {0.8, 0.2, 0.05, 0.015})
        for (const double sign : {-1.0, 1.0})
            for (double next = value(at + sign * step); next > most;
                 next = value(at + sign * step)) {
                most = next;
                at += sign * step;
            }
    return std::exp(at);
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

Variances maximise_likelihood(const GroupEquations& equations, Variances start,
                              const NoisePrior& prior, int sweeps) {
    double before = restricted_likelihood(equations, start, prior);
    for (int k = 0; k < sweeps; ++k) {
        for (std::size_t g = 0; g < equations.groups(); ++g)
            start.tau[g] = best_size(equations, start, g);
        start.nu = best_noise(equations, start, prior);
        const double now = restricted_likelihood(equations, start, prior);
        if (now - before < 0.01) break;
        before = now;
    }
    return start;
}

}  // namespace trunnion

#include "estimation/variance_groups.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "estimation/inner_products.h"
#include "estimation/lower_triangle.h"
#include "estimation/wide_vectors.h"

namespace trunnion::estimation {
namespace {

constexpr int sizes = 26;
constexpr double smallest = 0.01, largest = 1000.0;

double size_at(double step) {
    return smallest * std::pow(largest / smallest, step / (sizes - 1));
}

/// Sizes at steps of the grid from `first` on, `apart` from each other.
ReducedGroup::Eight eight_sizes(double first, double apart) {
    const double ratio = std::pow(largest / smallest, apart / (sizes - 1));
    ReducedGroup::Eight tau{size_at(first)};
    for (std::size_t k = 1; k < tau.size(); ++k) tau[k] = tau[k - 1] * ratio;
    return tau;
}

/// A reduced group with one product: gain as a function of the size.
struct Chain {
    const ReducedGroup& group;
    Eigen::VectorXd turned;
    double factor;
    ReducedGroup::Eight gains(const ReducedGroup::Eight& tau) const {
        return group.gains(turned, factor, tau);
    }
};

struct Peak {
    double step, gain;
};

/// Top of the parabola through a gain and those `h` steps before and after it.
double top_of_parabola(Peak at, double before, double after, double h) {
    const double bend = before - 2.0 * at.gain + after;
    if (bend >= 0.0) return at.step;
    return at.step + std::clamp(0.5 * h * (before - after) / bend, -h, h);
}

/// Refines the best size of the grid, given the gains one step before and after it.
Peak refined(const Chain& chain, const Peak& on_grid, double before, double after) {
    constexpr double apart = 0.1, middle = 3.0;
    const double first = top_of_parabola(on_grid, before, after, 1.0) - middle * apart;
    const ReducedGroup::Eight gain = chain.gains(eight_sizes(first, apart));
    const auto best =
        static_cast<std::size_t>(std::max_element(gain.begin(), gain.end()) - gain.begin());
    Peak at{first + apart * static_cast<double>(best), gain[best]};
    if (best > 0 && best + 1 < gain.size()) {
        const double top = top_of_parabola(at, gain[best - 1], gain[best + 1], apart);
        at = {top, chain.gains(eight_sizes(top, 0.0)).front()};
    }
    return at.gain > on_grid.gain ? at : on_grid;
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

/// Lower triangle of I + D G D / nu^2, padded by a unit matrix.
Eigen::MatrixXd scaled_gram(const GroupEquations& equations, const Eigen::VectorXd& tau,
                            double nu) {
    const Eigen::Index own = tau.size(), rows = padded_rows(own);
    Eigen::MatrixXd m = Eigen::MatrixXd::Zero(rows, rows);
    for (Eigen::Index j = 0; j < own; ++j)
        m.col(j).segment(j, own - j) =
            tau.tail(own - j).cwiseProduct(equations.gram.col(j).tail(own - j)) * tau(j) /
            (nu * nu);
    m.diagonal().array() += 1.0;
    return m;
}

constexpr double least_size = 1e-3;  ///< groups below this size count as absent

/// Standard deviation that maximises the likelihood of a remainder `square` with `freedom` degrees
/// of freedom and the prior: Newton's method for its logarithm. The likelihood has one maximum, so
/// that the least size is the best one where it is larger.
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
    return std::max(prior.least, std::exp(log_nu));
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
    Step(const GroupEquations& equations, Variances v, FactoredMembers factored,
         const NoisePrior& prior)
        : variances(std::move(v)),
          members(std::move(factored)),
          likelihood(likelihood_of(equations, members, prior)) {}
    Step(const GroupEquations& equations, const Variances& v, const NoisePrior& prior)
        : Step(equations, v, FactoredMembers(equations, v), prior) {}
};

/// The same sizes relative to the noise, with the noise that maximises the likelihood for them: the
/// factorisation depends on these ratios alone.
Step with_best_noise(const GroupEquations& equations, Variances variances,
                     const NoisePrior& prior) {
    FactoredMembers members(equations, variances);
    const double left = equations.square - members.z.squaredNorm() / (members.nu * members.nu);
    const double nu = best_noise(std::max(0.0, left), equations.rows, prior);
    const double times = nu / members.nu;
    variances.nu = members.nu = nu;
    for (double& tau : variances.tau) tau *= times;
    members.tau *= times;
    members.z *= times;
    return {equations, std::move(variances), std::move(members), prior};
}

/// Each group at its best size beside the others, then the noise.
Step one_sweep(const GroupEquations& equations, const Step& from, const NoisePrior& prior) {
    Variances next = from.variances;
    const auto groups =
        each_beside_others(equations, from.variances.tau, GivenMembers(from.members));
    for (std::size_t g = 0; g < groups.size(); ++g) next.tau[g] = group_gain(groups[g]).tau;
    return with_best_noise(equations, std::move(next), prior);
}

Variances between(const Variances& a, Variances b) {
    for (std::size_t g = 0; g < a.tau.size(); ++g)
        b.tau[g] = std::sqrt(std::max(a.tau[g], least_size) * b.tau[g]);
    b.nu = std::sqrt(a.nu * b.nu);
    return b;
}

}  // namespace

Variances not_absent(Variances variances) {
    for (double& tau : variances.tau) tau = std::max(tau, least_size);
    return variances;
}

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

Eigen::VectorXd FactoredMembers::mean() const {
    if (tau.size() == 0) return {};
    const auto own = factor.topLeftCorner(z.size(), z.size()).triangularView<Eigen::Lower>();
    return tau.cwiseProduct(own.transpose().solve(z)) / (nu * nu);
}

GivenMembers::GivenMembers(FactoredMembers factored) : nu_(factored.nu), z_(std::move(factored.z)) {
    const Eigen::VectorXd& tau = factored.tau;
    if (tau.size() == 0) return;
    half_ = inverse_of_lower(factored.factor).topLeftCorner(tau.size(), tau.size());
    for (Eigen::Index k = 0; k < tau.size(); ++k) half_.col(k) *= tau(k);
    mean_ = half_.triangularView<Eigen::Lower>().transpose() * z_ / (nu_ * nu_);
}

Eigen::MatrixXd GivenMembers::taken(const Eigen::MatrixXd& cross) const {
    // Without rows or columns Eigen would multiply by way of a null pointer.
    if (half_.size() == 0 || cross.cols() == 0) return Eigen::MatrixXd(half_.rows(), cross.cols());
    return upper_inner_products(half_.transpose(), cross) / (nu_ * nu_);
}

GroupInformation GivenMembers::leave_beside(const Eigen::Ref<const Eigen::MatrixXd>& taken,
                                            const Eigen::MatrixXd& gram,
                                            const Eigen::VectorXd& product) const {
    const double nu2 = nu_ * nu_;
    GroupInformation left{gram / nu2, product / nu2};
    if (half_.size() == 0) return left;
    left.information -= inner_products(taken);
    left.product.noalias() -= taken.transpose() * z_ / nu2;
    return left;
}

GroupInformation GivenMembers::leave(const Eigen::MatrixXd& cross, const Eigen::MatrixXd& gram,
                                     const Eigen::VectorXd& product) const {
    return leave_beside(taken(cross), gram, product);
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

namespace {

/// Where the tridiagonal information and a product are: `beside` from the second row on.
struct Rows {
    const double *diagonal, *beside, *turned;
    Eigen::Index count;
};

/// Gains at eight sizes, the largest last: its pivots are the largest, too.
TRUNNION_WIDE_VECTORS void gains_along(const Rows& rows, double factor, const double* tau,
                                       double* gain) {
    Lanes size{}, one{};
    load(tau, size);
    one += 1.0;
    const Lanes t2 = size * size, own = t2 * factor;
    Lanes quadratic{}, log_det{}, product = one, inverse = one, forward{};
    const auto take_logarithms = [&] {
        for (int k = 0; k < lanes; ++k) log_det[k] += std::log(product[k]);
        product = one;
    };
    for (Eigen::Index i = 0; i < rows.count; ++i) {
        const Lanes side = own * (i > 0 ? rows.beside[i - 1] : 0.0), part = side * inverse;
        forward = rows.turned[i] - part * forward;
        Lanes pivot = one + own * rows.diagonal[i] - part * side;
        // The exact pivots of I + a positive semidefinite matrix are never below 1.
        pivot = pivot > one ? pivot : one;
        inverse = one / pivot;
        quadratic += forward * forward * inverse;
        product *= pivot;
        if (product[lanes - 1] >= 1e150) take_logarithms();
    }
    take_logarithms();
    store(0.5 * (t2 * quadratic - log_det), gain);
}

}  // namespace

ReducedGroup::Eight ReducedGroup::gains(const Eigen::VectorXd& turned, double factor,
                                        const Eight& tau) const {
    Eight gain{};
    gains_along({diagonal_.data(), beside_.data(), turned.data(), diagonal_.size()}, factor,
                tau.data(), gain.data());
    return gain;
}

double gain_at(const GroupInformation& group, double tau) {
    const ReducedGroup reduced(group.information);
    ReducedGroup::Eight same{};
    same.fill(tau);
    return reduced.gains(reduced.turned(group.product), 1.0, same).front();
}

GroupGain group_gain(const GroupInformation& group) {
    return group_gain(ReducedGroup(group.information), group.product, 1.0);
}

namespace {

/// Gains at the sizes of the grid, from one before the first to some after the last, and the
/// position of the best one of the grid.
struct GridGains {
    std::array<double, 32> gain{};
    std::size_t best = 0;
    double mean() const;  ///< log of the mean likelihood ratio
};

GridGains gains_on_grid(const Chain& chain) {
    static const std::array<ReducedGroup::Eight, 4> grid{eight_sizes(-1, 1), eight_sizes(7, 1),
                                                         eight_sizes(15, 1), eight_sizes(23, 1)};
    GridGains on_grid;
    for (std::size_t k = 0; k < grid.size(); ++k) {
        const ReducedGroup::Eight eight = chain.gains(grid[k]);
        std::copy(eight.begin(), eight.end(), on_grid.gain.begin() + 8 * k);
    }
    const auto first = on_grid.gain.begin() + 1;
    on_grid.best =
        static_cast<std::size_t>(std::max_element(first, first + sizes) - on_grid.gain.begin());
    return on_grid;
}

double GridGains::mean() const {
    double sum = 0.0;
    for (std::size_t k = 1; k <= sizes; ++k) sum += std::exp(gain[k] - gain[best]);
    return gain[best] + std::log(sum / sizes);
}

}  // namespace

double mean_gain(const ReducedGroup& group, const Eigen::VectorXd& product, double factor) {
    return gains_on_grid({group, group.turned(product), factor}).mean();
}

GroupGain group_gain(const ReducedGroup& group, const Eigen::VectorXd& product, double factor) {
    const Chain chain{group, group.turned(product), factor};
    const GridGains all = gains_on_grid(chain);
    const Peak on_grid{static_cast<double>(all.best) - 1.0, all.gain[all.best]};
    const Peak peak = refined(chain, on_grid, all.gain[all.best - 1], all.gain[all.best + 1]);
    return {all.mean(), peak.gain, size_at(peak.step)};
}

std::vector<GroupInformation> each_beside_others(const GroupEquations& equations,
                                                 const std::vector<double>& tau,
                                                 const GivenMembers& all) {
    std::vector<GroupInformation> list;
    const Eigen::VectorXd& mean = all.mean();
    for (std::size_t g = 0; g < equations.groups(); ++g) {
        const Eigen::Index first = equations.first(g), count = equations.size[g];
        // R is lower triangular: the rows above the group's first row are zero in its columns.
        const auto own = all.half().block(first, first, all.half().rows() - first, count);
        const Eigen::LLT<Eigen::MatrixXd> covariance(inner_products(own));
        GroupInformation alone;
        alone.information = covariance.solve(Eigen::MatrixXd::Identity(count, count));
        alone.product = covariance.solve(mean.segment(first, count));
        alone.information.diagonal().array() -= 1.0 / (tau[g] * tau[g]);
        list.push_back(std::move(alone));
    }
    return list;
}

std::vector<GroupInformation> each_beside_others(const GroupEquations& equations,
                                                 const Variances& variances) {
    const Variances given = not_absent(variances);
    return each_beside_others(equations, given.tau, GivenMembers(equations, given));
}

BestVariances maximise_likelihood(const GroupEquations& equations, Variances start,
                                  const NoisePrior& prior, int sweeps) {
    constexpr int most_sweeps = 30;
    constexpr double far = 10.0;  // from the maximum: large effects in small noise
    Step now(equations, not_absent(std::move(start)), prior);
    double last = 0.0;
    for (int k = 0; k < sweeps || (last > far && k < most_sweeps); ++k) {
        Step next = one_sweep(equations, now, prior);
        // Written so that a likelihood that cannot be computed (NaN) is a worse one.
        const auto worse = [&] { return !(next.likelihood >= now.likelihood); };
        for (int halved = 0; worse() && halved < 4; ++halved)
            next = Step(equations, between(now.variances, std::move(next.variances)), prior);
        if (worse()) break;
        last = next.likelihood - now.likelihood;
        now = std::move(next);
        if (last < 0.01) break;
    }
    return {std::move(now.variances), now.likelihood, now.members.mean()};
}

}  // namespace trunnion::estimation

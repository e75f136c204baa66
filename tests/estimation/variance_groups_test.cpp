// Restricted likelihood of groups against brute force on the whole covariance matrix.
#include "estimation/variance_groups.h"

#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <cmath>

#include "base/random.h"
#include "estimation/projection.h"

namespace trunnion {
namespace {

Eigen::MatrixXd normals(Eigen::Index rows, Eigen::Index columns, SeededNoise& random) {
    Eigen::MatrixXd m(rows, columns);
    for (Eigen::Index i = 0; i < rows; ++i)
        for (Eigen::Index j = 0; j < columns; ++j) m(i, j) = random.normal();
    return m;
}

/// A small problem: three flat columns, groups of two, one and five columns.
struct Bench {
    SeededNoise random{7};
    Eigen::MatrixXd flat = normals(40, 3, random), columns = normals(40, 8, random);
    Eigen::VectorXd data = normals(40, 1, random);
    std::vector<Eigen::Index> size{2, 1, 5};

    estimation::GroupEquations equations() const {
        const estimation::Projection known(flat);
        const Eigen::MatrixXd a = known.beside(columns);
        const Eigen::VectorXd y = known.beside(data);
        return {a.transpose() * a, a.transpose() * y, y.squaredNorm(), 40.0 - 3.0, size};
    }
    /// ln N(y) restricted to the complement of the flat columns, from the full covariance.
    double brute(const std::vector<double>& tau, double nu) const {
        Eigen::MatrixXd v = nu * nu * Eigen::MatrixXd::Identity(40, 40);
        Eigen::Index at = 0;
        for (std::size_t g = 0; g < size.size(); at += size[g++])
            v += tau[g] * tau[g] * columns.middleCols(at, size[g]) *
                 columns.middleCols(at, size[g]).transpose();
        const Eigen::FullPivLU<Eigen::MatrixXd> null(flat.transpose());
        const Eigen::MatrixXd k = estimation::Projection(null.kernel()).basis();  // K'flat = 0
        const Eigen::MatrixXd inside = k.transpose() * v * k;
        const Eigen::VectorXd y = k.transpose() * data;
        return -0.5 * (std::log(inside.determinant()) + y.dot(inside.inverse() * y));
    }
};

}  // namespace

TEST_CASE("the restricted likelihood agrees with the whole covariance matrix", "[estimation]") {
    const Bench bench;
    const estimation::NoisePrior none{0.0, 1e9};
    const estimation::GroupEquations equations = bench.equations();
    const auto mine = [&](std::vector<double> tau, double nu) {
        return estimation::restricted_likelihood(equations, {std::move(tau), nu}, none);
    };
    const double start = mine({0, 0, 0}, 1.0) - bench.brute({0, 0, 0}, 1.0);
    for (const double nu : {0.5, 1.0, 3.0})
        for (const double tau : {0.0, 0.1, 2.0, 40.0})
            CHECK(mine({tau, 0.3, 2 * tau}, nu) - bench.brute({tau, 0.3, 2 * tau}, nu) ==
                  Approx(start).margin(1e-9));
}

TEST_CASE("the gain of a group is the likelihood with it less that without", "[estimation]") {
    const Bench bench;
    const estimation::NoisePrior none{0.0, 1e9};
    const estimation::GroupEquations all = bench.equations();
    estimation::GroupEquations two{
        all.gram.topLeftCorner(3, 3), all.product.head(3), all.square, all.rows, {2, 1}};
    const estimation::Variances given{{0.7, 1.3}, 0.9};
    const estimation::GroupInformation left =
        estimation::GivenMembers(two, given)
            .leave(all.gram.topRightCorner(3, 5), all.gram.bottomRightCorner(5, 5),
                   all.product.tail(5));
    for (const double tau : {0.02, 0.5, 7.0})
        CHECK(estimation::gain_at(left, tau) ==
              Approx(estimation::restricted_likelihood(all, {{0.7, 1.3, tau}, 0.9}, none) -
                     estimation::restricted_likelihood(two, given, none))
                  .margin(1e-9));
    const estimation::GroupGain gain = estimation::group_gain(left);
    CHECK(gain.best >= gain.mean);
    for (const double tau : {0.02, 0.1, 0.5, 2.0, 7.0})
        CHECK(gain.best >= estimation::gain_at(left, tau) - 1e-6);
}

TEST_CASE("the best size of a group stands between those of the grid", "[estimation]") {
    const Bench bench;
    const estimation::GroupEquations all = bench.equations();
    const estimation::GroupEquations two{
        all.gram.topLeftCorner(3, 3), all.product.head(3), all.square, all.rows, {2, 1}};
    estimation::GroupInformation left =
        estimation::GivenMembers(two, {{0.7, 1.3}, 0.9})
            .leave(all.gram.topRightCorner(3, 5), all.gram.bottomRightCorner(5, 5),
                   all.product.tail(5));
    left.product *= 4.0;  // large enough for the group to be seen
    for (int k = 0; k < 12; ++k) {
        const estimation::GroupGain gain = estimation::group_gain(left);
        double most = 0.0;
        for (double tau = 0.02; tau < 100.0; tau *= 1.01)
            most = std::max(most, estimation::gain_at(left, tau));
        INFO(k);
        CHECK(most > 0.5);
        CHECK(gain.best == Approx(most).epsilon(1e-4));
        CHECK(gain.best == Approx(estimation::gain_at(left, gain.tau)).epsilon(1e-9));
        left.product *= 1.1;  // another size is the best one
    }
}

TEST_CASE("the mean gain is that of 26 sizes from 0.01 to 1000, evenly in their logarithm",
          "[estimation]") {
    for (const double product : {0.0, 3.0, 8.0}) {
        const estimation::GroupInformation group{Eigen::MatrixXd::Constant(1, 1, 2.0),
                                                 Eigen::VectorXd::Constant(1, product)};
        double sum = 0.0;
        for (int k = 0; k <= 25; ++k)
            sum += std::exp(estimation::gain_at(group, 0.01 * std::pow(1e5, k / 25.0)));
        CHECK(estimation::group_gain(group).mean == Approx(std::log(sum / 26.0)).margin(1e-9));
    }
}

TEST_CASE("one factorisation says what each group is beside the others", "[estimation]") {
    const Bench bench;
    const estimation::GroupEquations all = bench.equations();
    const estimation::Variances v{{0.7, 1.3, 0.2}, 0.9};
    const auto each = estimation::each_beside_others(all, v);
    estimation::GroupEquations two{
        all.gram.topLeftCorner(3, 3), all.product.head(3), all.square, all.rows, {2, 1}};
    const estimation::GroupInformation last =
        estimation::GivenMembers(two, {{0.7, 1.3}, 0.9})
            .leave(all.gram.topRightCorner(3, 5), all.gram.bottomRightCorner(5, 5),
                   all.product.tail(5));
    CHECK((each[2].information - last.information).norm() < 1e-9 * last.information.norm());
    CHECK((each[2].product - last.product).norm() < 1e-9 * last.product.norm());
}

TEST_CASE("the likelihood is at its maximum", "[estimation]") {
    const Bench bench;
    const estimation::GroupEquations all = bench.equations();
    const estimation::NoisePrior prior{0.0, 0.5};
    const auto [best, most, mean] =
        estimation::maximise_likelihood(all, {{1, 1, 1}, 1.0}, prior, 60);
    CHECK(most == estimation::restricted_likelihood(all, best, prior));
    const Eigen::VectorXd by_inverse = estimation::GivenMembers(all, best).mean();
    CHECK((mean - by_inverse).norm() < 1e-12 * by_inverse.norm());
    for (std::size_t g = 0; g < 3; ++g)
        for (const double factor : {0.8, 1.25}) {
            estimation::Variances other = best;
            other.tau[g] *= factor;
            CHECK(estimation::restricted_likelihood(all, other, prior) < most + 0.05);
        }
    for (const double factor : {0.95, 1.05}) {
        estimation::Variances other = best;
        other.nu *= factor;
        CHECK(estimation::restricted_likelihood(all, other, prior) < most + 0.05);
    }
}

TEST_CASE("the noise of few readings stands between its prior and their scatter", "[estimation]") {
    const estimation::GroupEquations none{
        Eigen::MatrixXd(0, 0), Eigen::VectorXd(0), 9.0 * 20.0, 20.0, {}};
    for (const double spread : {0.05, 0.2, 1.0}) {
        const estimation::NoisePrior prior{0.0, spread};
        const auto [best, most, mean] = estimation::maximise_likelihood(none, {{}, 1.0}, prior, 20);
        CHECK(mean.size() == 0);
        CHECK(best.nu > 1.0);
        CHECK(best.nu < 3.0);
        for (const double factor : {0.98, 1.02})
            CHECK(estimation::restricted_likelihood(none, {{}, factor * best.nu}, prior) < most);
    }
}

TEST_CASE("the maximum of the likelihood is the same from far away", "[estimation]") {
    const Bench bench;
    const estimation::GroupEquations all = bench.equations();
    const estimation::NoisePrior prior{0.0, 0.5};
    const double most =
        estimation::maximise_likelihood(all, {{1, 1, 1}, 1.0}, prior, 60).likelihood;
    for (const double tau : {0.02, 30.0})
        for (const double nu : {0.1, 20.0}) {
            INFO(tau << " " << nu);
            CHECK(estimation::maximise_likelihood(all, {{tau, 1 / tau, tau}, nu}, prior, 60)
                      .likelihood == Approx(most).margin(0.05));
        }
}

TEST_CASE("a large effect in little noise is followed to its maximum in two sweeps of the caller",
          "[estimation]") {
    // As an encoder of milliradians with a noise of microradians: a smooth decreasing group.
    SeededNoise random{11};
    const Eigen::Index rows = 150, count = 44;
    Eigen::MatrixXd columns = normals(rows, count, random);
    for (Eigen::Index k = 0; k < count; ++k)
        columns.col(k) /= 1.0 + std::pow(static_cast<double>(k) / 8.0, 2);
    const Eigen::VectorXd data =
        2000.0 * columns * normals(count, 1, random) + 1.0 * normals(rows, 1, random);
    const estimation::GroupEquations equations{columns.transpose() * columns,
                                               columns.transpose() * data,
                                               data.squaredNorm(),
                                               static_cast<double>(rows),
                                               {count}};
    const estimation::NoisePrior prior{0.0, 0.7};
    const estimation::Variances start{{1.0}, 5000.0};
    const auto few = estimation::maximise_likelihood(equations, start, prior, 2);
    const auto many = estimation::maximise_likelihood(equations, start, prior, 60);
    CHECK(few.likelihood > many.likelihood - 10.0);
    CHECK(few.variances.nu == Approx(1.0).epsilon(0.2));
}

TEST_CASE("mean and covariance are those of the ridge fit", "[estimation]") {
    const Bench bench;
    const estimation::GroupEquations equations = bench.equations();
    const estimation::Variances v{{0.7, 1.3, 0.2}, 0.9};
    const estimation::GivenMembers given(equations, v);
    Eigen::VectorXd precision(8);
    precision << 1 / 0.49, 1 / 0.49, 1 / 1.69, 25, 25, 25, 25, 25;
    const Eigen::MatrixXd information =
        equations.gram / 0.81 + Eigen::MatrixXd(precision.asDiagonal());
    CHECK((given.covariance() - information.inverse()).norm() < 1e-9);
    CHECK((given.mean() - information.inverse() * equations.product / 0.81).norm() < 1e-9);
}

TEST_CASE("the variance of 200 offsets and of the noise is found", "[estimation]") {
    SeededNoise random(3);
    constexpr Eigen::Index tests = 200, each = 6;
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(tests * each, tests);
    Eigen::VectorXd y(tests * each);
    for (Eigen::Index t = 0; t < tests; ++t) {
        const double zero = 2.5 * random.normal();
        for (Eigen::Index k = t * each; k < (t + 1) * each; ++k) {
            a(k, t) = 1.0;
            y(k) = zero + 1.4 * random.normal();
        }
    }
    const estimation::GroupEquations equations{a.transpose() * a,
                                               a.transpose() * y,
                                               y.squaredNorm(),
                                               static_cast<double>(tests * each),
                                               {tests}};
    const estimation::Variances found =
        estimation::maximise_likelihood(equations, {{1.0}, 1.0}, {std::log(1.0), 0.7}, 10)
            .variances;
    CHECK(found.tau[0] == Approx(2.5).epsilon(0.15));
    CHECK(found.nu == Approx(1.4).epsilon(0.05));
}

TEST_CASE("a group that is not there gets next to nothing", "[estimation]") {
    SeededNoise random(11);
    const Eigen::MatrixXd a = normals(300, 4, random);
    const Eigen::VectorXd y = normals(300, 1, random);
    const estimation::GroupGain gain =
        estimation::group_gain({a.transpose() * a, a.transpose() * y});
    CHECK(gain.mean < 1.0);
    CHECK(gain.tau < 0.3);
}

TEST_CASE("without members there is a factor too, and it may be copied", "[estimation]") {
    const estimation::GroupEquations none{Eigen::MatrixXd(0, 0), Eigen::VectorXd(0), 4.0, 9.0, {}};
    const estimation::FactoredMembers members(none, {{}, 2.0});
    const estimation::FactoredMembers copied = members;  // a sanitizer reads what it holds
    CHECK(copied.factor.rows() == 0);
    CHECK(copied.log_determinant == 0.0);
}

}  // namespace trunnion

// Ranked least squares, projection, pure error, distributions, free forms.
#include <catch2/catch.hpp>
#include <cmath>

#include "base/random.h"
#include "estimation/distributions.h"
#include "estimation/free_form.h"
#include "estimation/projection.h"
#include "estimation/pure_error.h"
#include "estimation/quantiles.h"
#include "estimation/ranked_least_squares.h"

namespace trunnion {

TEST_CASE("distribution tails", "[estimation]") {
    CHECK(estimation::chi_squared_tail(3.841458820694124, 1) == Approx(0.05));
    CHECK(estimation::chi_squared_tail(124.342113404004, 100) == Approx(0.05));
    CHECK(estimation::f_tail(4.102821015, 2, 10) == Approx(0.05));
    CHECK(estimation::f_tail(1.0, 7, 7) == Approx(0.5));
    CHECK(estimation::normal_tail(1.959963984540054) == Approx(0.025));
    CHECK(estimation::student_probability(2.131846786326649, 4) == Approx(0.95));
    CHECK(estimation::student_probability(-2.131846786326649, 4) == Approx(0.05));
    CHECK(estimation::binomial_tail(9, 9, 1.0 / 3.0) == Approx(1.0 / 19683.0));
    CHECK(estimation::binomial_tail(1, 2, 0.5) == Approx(0.75));
    CHECK(estimation::chi_squared_tail(1e6, 0) == 1.0);
    // A log that agrees to its last digit: nothing left of thousands of terms.
    for (const double left : {1e-300, 1e-12, 1.0, 390.0})
        CHECK(estimation::chi_squared_tail(left, 3957) == 1.0);
    CHECK(estimation::chi_squared_tail(9.9, 100) == 1.0);
    CHECK(estimation::chi_squared_tail(10.1, 100) == Approx(1.0));
    // What cannot be computed is no evidence.
    for (const double none : {0.0, -2.0, std::nan("")}) {
        CHECK(estimation::f_tail(3.0, none, 10) == 1.0);
        CHECK(estimation::f_tail(3.0, 2, none) == 1.0);
        CHECK(estimation::f_tail(none, 2, 10) == 1.0);
    }
    CHECK(estimation::student_probability(2.0, 0) == 1.0);
    CHECK(estimation::student_probability(-2.0, 0) == 1.0);
    CHECK(estimation::binomial_tail(3, 2, 0.5) == 0.0);
    CHECK(estimation::binomial_tail(2, 2, 1.0) == 1.0);
    CHECK(estimation::binomial_tail(0, 2, 0.5) == 1.0);
    CHECK(estimation::chi_squared_tail(1e9, 3) == 0.0);
    CHECK(estimation::quantile({4, 1, 3, 2}, 0.5) == Approx(2.5));
    CHECK(estimation::robust_deviation({}) == 0.0);
}

TEST_CASE("a direction that no reading sees is named and stays at zero", "[estimation]") {
    Eigen::MatrixXd a(4, 3);  // columns 0 and 1 move all readings alike
    a << 1, 1, 0, 2, 2, 1, 3, 3, 0, 4, 4, 5;
    const Eigen::VectorXd y = a * Eigen::Vector3d(0.5, 0.5, -2.0);
    const estimation::LinearFit fit =
        estimation::solve_ranked(a.transpose() * a, a.transpose() * y);
    REQUIRE(fit.null_space.size() == 1);
    CHECK(fit.null_space[0](0) == Approx(-fit.null_space[0](1)));
    CHECK(fit.value(0) == Approx(0.5));
    CHECK(fit.value(2) == Approx(-2.0));
    CHECK(std::isnan(fit.sigma(0)));
    CHECK(std::isfinite(fit.sigma(2)));
    CHECK(estimation::explained(a.transpose() * a, a.transpose() * y) == Approx(y.squaredNorm()));
    CHECK(estimation::explained(Eigen::MatrixXd(0, 0), Eigen::VectorXd(0)) == 0.0);
    CHECK(estimation::explained(Eigen::MatrixXd::Zero(2, 2), Eigen::Vector2d(1.0, 2.0)) == 0.0);
    CHECK(estimation::solve_ranked(Eigen::MatrixXd(0, 0), Eigen::VectorXd(0)).value.size() == 0);
}

TEST_CASE("what columns explain beside others is the fall of the squared sum", "[estimation]") {
    SeededNoise random(5);
    Eigen::MatrixXd known(30, 4), own(30, 2);
    Eigen::VectorXd y(30);
    for (Eigen::Index i = 0; i < 30; ++i) {
        for (Eigen::Index j = 0; j < 3; ++j) known(i, j) = random.normal();
        known(i, 3) = known(i, 0) - known(i, 1);  // says nothing new
        own(i, 0) = random.normal();
        own(i, 1) = known(i, 2);  // nothing beside the known
        y(i) = random.normal();
    }
    const estimation::Projection projection(known);
    CHECK(projection.rank() == 3);
    Eigen::MatrixXd both(30, 5);
    both << known, own.col(0);
    const double fall =
        projection.beside(y).squaredNorm() - estimation::Projection(both).beside(y).squaredNorm();
    CHECK(estimation::explained_beside(projection, own, y) == Approx(fall));
    CHECK(estimation::explained_beside(estimation::Projection(Eigen::MatrixXd(30, 0)),
                                       Eigen::MatrixXd(30, 0), y) == 0.0);
}

TEST_CASE("pure error is the scatter inside settings", "[estimation]") {
    SeededNoise random(9);
    Eigen::VectorXd v(900);
    std::vector<int> setting(900);
    for (Eigen::Index i = 0; i < 900; ++i) {
        setting[static_cast<std::size_t>(i)] = static_cast<int>(i % 300);
        v(i) = 50.0 * std::sin(static_cast<double>(i % 300)) + 0.7 * random.normal();
    }
    const estimation::PureError e = estimation::pure_error(v, setting);
    CHECK(e.freedom == 600.0);
    CHECK(std::sqrt(e.variance) == Approx(0.7).epsilon(0.08));
    v(17) += 100.0;  // a wild reading does not set the noise
    CHECK(std::sqrt(estimation::pure_error(v, setting).variance) == Approx(0.7).epsilon(0.15));
    CHECK(estimation::pure_error(v, std::vector<int>(900, -1)).freedom == 0.0);
    // Most readings repeat exactly, as those of a coarse scale do: nothing is clipped.
    Eigen::VectorXd coarse = Eigen::VectorXd::Zero(20);
    coarse(0) = 0.01;
    std::vector<int> pairs;
    for (int k = 0; k < 20; ++k) pairs.push_back(k / 2);
    CHECK(estimation::pure_error(coarse, pairs).variance == Approx(0.01 * 0.01 / 20.0));
}

TEST_CASE("places of a free form go together as Matern 3/2 of their distance says",
          "[estimation]") {
    const std::vector<double> knots{0.0, 10.0, 25.0, 70.0};
    const double length = 20.0;
    const Eigen::MatrixXd shape =
        estimation::smooth_shapes(knots, length, Eigen::MatrixXd(4, 0), 4);
    for (Eigen::Index i = 0; i < 4; ++i)
        for (Eigen::Index j = 0; j < 4; ++j) {
            const double s =
                std::sqrt(3.0) / length *
                std::abs(knots[static_cast<std::size_t>(i)] - knots[static_cast<std::size_t>(j)]);
            CHECK((shape * shape.transpose())(i, j) ==
                  Approx((1.0 + s) * std::exp(-s)).margin(1e-9));
        }
}

TEST_CASE("free forms leave out what the textbook owns and follow any smooth curve",
          "[estimation]") {
    std::vector<double> places;
    for (int k = 0; k <= 30; ++k) places.push_back(10.0 * k);
    const std::vector<double> knots = estimation::knots_of(places, 40);
    REQUIRE(knots.size() == 31);
    CHECK(estimation::knots_of(places, 12).size() == 12);
    CHECK(estimation::knots_of({3.0, 3.0}, 12).empty());
    CHECK(estimation::knots_of({-10.0, -10.0 + 1e-9, 10.0}, 12).size() == 2);
    const auto [before, weight] = estimation::place_between(knots, 104.0);
    CHECK(before == 10);
    CHECK(weight == Approx(0.4));
    CHECK(estimation::place_between(knots, 900.0).second == 1.0);
    const Eigen::MatrixXd line = estimation::polynomials_at(knots, 2);
    CHECK(line(0, 1) == -1.0);
    CHECK(line(30, 1) == 1.0);
    const auto lengths = estimation::correlation_lengths(knots);
    REQUIRE(lengths.size() == 4);
    // No length shorter than most distances of the knots.
    CHECK(estimation::correlation_lengths({0.0, 10.0, 20.0, 30.0}) ==
          std::vector<double>{15.0, 7.5});
    // Of few knots the shortest one is near 0.6 of their distance, so that each has its own value.
    CHECK(estimation::correlation_lengths({0.0, 10.0, 20.0, 30.0, 40.0, 50.0}) ==
          std::vector<double>{25.0, 12.5, 6.25});
    CHECK(estimation::correlation_lengths({0.0, 10.0, 20.0}) == std::vector<double>{10.0, 6.0});
    const Eigen::MatrixXd shape = estimation::smooth_shapes(knots, lengths[2], line, 24);
    CHECK((line.transpose() * shape).cwiseAbs().maxCoeff() < 1e-9);
    Eigen::VectorXd curve(31);
    for (Eigen::Index k = 0; k < 31; ++k)
        curve(k) = std::sin(0.02 * knots[static_cast<std::size_t>(k)] + 1.0);
    const Eigen::VectorXd bent = estimation::Projection(line).beside(curve);
    CHECK(estimation::Projection(shape).beside(bent).norm() < 0.02 * bent.norm());
}

}  // namespace trunnion

// A fit that spoiled rows cannot pull: against a line computed by hand.
#include "estimation/trimmed_fit.h"

#include <catch2/catch.hpp>
#include <cmath>

namespace trunnion {

TEST_CASE("a line through 25 points of which a fifth lies anywhere", "[estimation]") {
    constexpr Eigen::Index n = 25;
    Eigen::MatrixXd columns(n, 2);
    Eigen::VectorXd data(n), truth(n);
    for (Eigen::Index i = 0; i < n; ++i) {
        const auto x = static_cast<double>(i);
        columns.row(i) << 1.0, x;
        truth(i) = 3.0 - 0.5 * x;
        data(i) = truth(i) + 0.1 * std::sin(7.0 * x);
    }
    // At one end, where they have most leverage: least squares follow them.
    for (const Eigen::Index i : {20, 21, 22, 23, 24}) data(i) = truth(i) + 40.0;
    const Eigen::VectorXd left = estimation::trimmed_residual(columns, data, data, 0.2);
    CHECK(left.head(20).cwiseAbs().maxCoeff() < 0.3);
    CHECK(left.tail(5).minCoeff() > 39.0);
    const Eigen::VectorXd again = estimation::trimmed_residual(columns, data, data, 0.2);
    CHECK(left == again);
}

TEST_CASE("without spoiled rows, columns or rows a trimmed fit is no trouble", "[estimation]") {
    Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(30, 2);
    columns.col(0).setOnes();  // the second is not observable
    const Eigen::VectorXd data = Eigen::VectorXd::Constant(30, 2.0);
    CHECK(estimation::trimmed_residual(columns, data, data, 0.2).cwiseAbs().maxCoeff() < 1e-12);
    CHECK(estimation::trimmed_residual(Eigen::MatrixXd(30, 0), data, data, 0.2) == data);
    CHECK(estimation::trimmed_residual(Eigen::MatrixXd(0, 2), Eigen::VectorXd(0),
                                       Eigen::VectorXd(0), 0.2)
              .size() == 0);
}

}  // namespace trunnion

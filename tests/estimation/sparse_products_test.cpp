#include "estimation/sparse_products.h"

#include <catch2/catch.hpp>

#include "base/random.h"

using namespace trunnion;

TEST_CASE("products with sparse columns are the sums over the rows in their order",
          "[estimation]") {
    SeededNoise random(19);
    for (const Eigen::Index rows : {0, 1, 40})
        for (const Eigen::Index columns : {0, 1, 7, 8, 9, 17}) {
            const Eigen::MatrixXd dense =
                Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return random.normal(); });
            const Eigen::MatrixXd table = Eigen::MatrixXd::NullaryExpr(rows, 5, [&] {
                const double value = random.normal();
                return value > 0.5 ? value : 0.0;
            });
            Eigen::MatrixXd plain = Eigen::MatrixXd::Zero(columns, 5);
            for (Eigen::Index k = 0; k < rows; ++k)
                for (Eigen::Index i = 0; i < columns; ++i)
                    for (Eigen::Index j = 0; j < 5; ++j) plain(i, j) += table(k, j) * dense(k, i);
            const Eigen::MatrixXd found = estimation::sparse_products(dense, table.sparseView());
            INFO(rows << " " << columns);
            REQUIRE(found.rows() == columns);
            REQUIRE(found.cols() == 5);
            CHECK((found - plain).isZero(0.0));
        }
}

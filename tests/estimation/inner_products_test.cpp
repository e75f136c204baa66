#include "estimation/inner_products.h"

#include <catch2/catch.hpp>

#include "base/random.h"

using namespace trunnion;

namespace {

Eigen::MatrixXd normals(Eigen::Index rows, Eigen::Index columns, SeededNoise& random) {
    return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return random.normal(); });
}

double difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
    return a.size() == 0 ? 0.0 : (a - b).cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE("products of columns are those of one element after the other", "[estimation]") {
    SeededNoise random(17);
    for (const Eigen::Index rows : {0, 1, 7, 8, 9, 511, 512, 513, 1030})
        for (const Eigen::Index tall : {0, 1, 3, 4, 5, 9})
            for (const Eigen::Index broad : {0, 1, 2, 3, 6}) {
                const Eigen::MatrixXd a = normals(rows, tall, random),
                                      b = normals(rows, broad, random);
                Eigen::MatrixXd plain = Eigen::MatrixXd::Zero(tall, broad);
                for (Eigen::Index k = 0; k < rows; ++k)
                    for (Eigen::Index i = 0; i < tall; ++i)
                        for (Eigen::Index j = 0; j < broad; ++j) plain(i, j) += a(k, i) * b(k, j);
                const Eigen::MatrixXd found = estimation::inner_products(a, b);
                INFO(rows << " " << tall << " " << broad);
                REQUIRE(found.rows() == tall);
                REQUIRE(found.cols() == broad);
                CHECK(difference(found, plain) < 1e-12);
                CHECK(difference(estimation::inner_products(b, a).transpose(), found) == 0.0);
            }
}

TEST_CASE("a matrix with itself, part of a matrix, and a triangle", "[estimation]") {
    SeededNoise random(18);
    for (const Eigen::Index n : {1, 2, 5, 8, 13, 31}) {
        const Eigen::MatrixXd all = normals(2 * n + 3, n + 4, random);
        const auto part = all.block(3, 2, n, n);
        const Eigen::MatrixXd own = part, b = normals(n, 6, random);
        INFO(n);
        CHECK(difference(estimation::inner_products(part), estimation::inner_products(own, own)) ==
              0.0);
        const Eigen::MatrixXd upper = own.triangularView<Eigen::Upper>();
        CHECK(difference(estimation::upper_inner_products(upper, b),
                         estimation::inner_products(upper, b)) < 1e-13);
    }
}

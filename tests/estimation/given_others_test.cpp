// Members without one of them, and the triangles behind every factorisation.
#include "estimation/given_others.h"

#include <Eigen/Cholesky>
#include <catch2/catch.hpp>

#include "base/random.h"
#include "estimation/lower_triangle.h"

namespace trunnion {
namespace {

using estimation::GroupEquations;

Eigen::MatrixXd normals(Eigen::Index rows, Eigen::Index columns, SeededNoise& random) {
    Eigen::MatrixXd m(rows, columns);
    for (Eigen::Index i = 0; i < rows; ++i)
        for (Eigen::Index j = 0; j < columns; ++j) m(i, j) = random.normal();
    return m;
}

/// Five groups on 60 rows: three members, one that takes the place of the second, one that looks
/// at them.
struct Bench {
    SeededNoise random{11};
    Eigen::MatrixXd columns = normals(60, 19, random);
    Eigen::VectorXd data = normals(60, 1, random);
    std::vector<Eigen::Index> size{3, 5, 2, 6, 3};
    estimation::Variances sizes{{0.7, 1.4, 0.2}, 0.8};

    Eigen::MatrixXd of(std::size_t group) const {
        Eigen::Index first = 0;
        for (std::size_t g = 0; g < group; ++g) first += size[g];
        return columns.middleCols(first, size[group]);
    }
    GroupEquations equations(const std::vector<std::size_t>& members) const {
        GroupEquations e{{}, {}, data.squaredNorm(), 60.0, {}};
        Eigen::MatrixXd all(60, 0);
        for (const std::size_t m : members) {
            e.size.push_back(size[m]);
            all.conservativeResize(60, all.cols() + size[m]);
            all.rightCols(size[m]) = of(m);
        }
        e.gram = all.transpose() * all;
        e.product = all.transpose() * data;
        return e;
    }
    Eigen::MatrixXd cross(const std::vector<std::size_t>& members, std::size_t group) const {
        Eigen::MatrixXd all(0, size[group]);
        for (const std::size_t m : members) {
            all.conservativeResize(all.rows() + size[m], size[group]);
            all.bottomRows(size[m]) = of(m).transpose() * of(group);
        }
        return all;
    }
    estimation::GroupInformation left(const estimation::GivenMembers& given,
                                      const std::vector<std::size_t>& members,
                                      std::size_t group) const {
        return given.leave(cross(members, group), cross({group}, group),
                           of(group).transpose() * data);
    }
};

void check_same(const estimation::GroupInformation& a, const estimation::GroupInformation& b) {
    CHECK((a.information - b.information).norm() < 1e-10 * b.information.norm());
    CHECK((a.product - b.product).norm() < 1e-10 * b.product.norm());
}

}  // namespace

TEST_CASE("members without one are as if it had never been there", "[estimation]") {
    const Bench b;
    const estimation::NoisePrior none{0.0, 1e9};
    const estimation::GivenMembers all(b.equations({0, 1, 2}), b.sizes);
    const std::vector<std::size_t> rest{0, 2};
    const estimation::Variances of_rest{{0.7, 0.2}, 0.8};
    const estimation::GivenMembers alone(b.equations(rest), of_rest);

    const estimation::GivenOthers others(all, 3, 5, 1.4);
    check_same(others.leave(all.taken(b.cross({0, 1, 2}, 4)), b.left(all, {0, 1, 2}, 4)),
               b.left(alone, rest, 4));
    CHECK((others.mean().head(3) - alone.mean().head(3)).norm() < 1e-10);
    CHECK((others.mean().tail(2) - alone.mean().tail(2)).norm() < 1e-10);
    CHECK(others.mean().segment(3, 5).norm() == 0.0);
    CHECK(others.gained() ==
          Approx(estimation::restricted_likelihood(b.equations(rest), of_rest, none) -
                 estimation::restricted_likelihood(b.equations({0, 1, 2}), b.sizes, none))
              .margin(1e-9));
}

TEST_CASE("another group in the place of a member is as a model with it", "[estimation]") {
    const Bench b;
    const estimation::NoisePrior none{0.0, 1e9};
    const std::vector<std::size_t> before{0, 1, 2}, after{0, 3, 2};
    const estimation::GivenMembers all(b.equations(before), b.sizes);
    const estimation::GivenMembers alone(b.equations(after), b.sizes);

    estimation::GivenOthers others(all, 3, 5, 1.4);
    others.replace(all.taken(b.cross(before, 3)), b.left(all, before, 3), 1.4);
    check_same(others.leave(all.taken(b.cross(before, 4)), b.left(all, before, 4), b.cross({3}, 4)),
               b.left(alone, after, 4));
    CHECK((others.mean().head(3) - alone.mean().head(3)).norm() < 1e-10);
    CHECK((others.mean_in_place() - alone.mean().segment(3, 6)).norm() < 1e-10);
    CHECK((others.mean().tail(2) - alone.mean().tail(2)).norm() < 1e-10);
    CHECK(others.gained() ==
          Approx(estimation::restricted_likelihood(b.equations(after), b.sizes, none) -
                 estimation::restricted_likelihood(b.equations(before), b.sizes, none))
              .margin(1e-9));
}

TEST_CASE("factor and inverse of triangles of any size", "[estimation]") {
    SeededNoise random{3};
    for (const Eigen::Index own : {1, 7, 8, 9, 31, 100}) {
        CAPTURE(own);
        const Eigen::MatrixXd columns = normals(own, own + 3, random);
        const Eigen::Index rows = estimation::padded_rows(own);
        Eigen::MatrixXd m = Eigen::MatrixXd::Identity(rows, rows);
        m.topLeftCorner(own, own) += columns * columns.transpose();
        Eigen::MatrixXd factor = m;
        estimation::factor_in_place(factor);
        const Eigen::MatrixXd lower = factor.triangularView<Eigen::Lower>();
        CHECK((lower - Eigen::MatrixXd(m.llt().matrixL())).norm() < 1e-12 * m.norm());
        const Eigen::MatrixXd inverse = estimation::inverse_of_lower(factor);
        CHECK((inverse * lower - Eigen::MatrixXd::Identity(rows, rows)).norm() < 1e-10);
        CHECK(Eigen::MatrixXd(inverse.triangularView<Eigen::StrictlyUpper>()).norm() == 0.0);
    }
}

TEST_CASE("a matrix that is not positive definite has no factor", "[estimation]") {
    Eigen::MatrixXd m = Eigen::MatrixXd::Identity(8, 8);
    m(2, 2) = -1.0;
    estimation::factor_in_place(m);
    CHECK(std::isnan(m(2, 2)));
}

}  // namespace trunnion

// Products that a search uses, against the columns themselves.
#include <algorithm>
#include <catch2/catch.hpp>

#include "base/random.h"
#include "diagnosis/search/heldout.h"
#include "diagnosis/search/offers.h"

namespace trunnion {
namespace {

constexpr Eigen::Index rows = 90;

Eigen::MatrixXd noise(SeededNoise& random, Eigen::Index columns) {
    Eigen::MatrixXd m(rows, columns);
    for (double& v : m.reshaped()) v = random.normal();
    return m;
}

/// Hat functions of time at some places: each row has two values, the rest is zero.
Eigen::MatrixXd hats(Eigen::Index places) {
    Eigen::MatrixXd m = Eigen::MatrixXd::Zero(rows, places);
    for (Eigen::Index i = 0; i < rows; ++i) {
        const double at = static_cast<double>(i * (places - 1)) / static_cast<double>(rows);
        const auto before = static_cast<Eigen::Index>(at);
        m(i, before) = 1.0 - (at - static_cast<double>(before));
        m(i, before + 1) = at - static_cast<double>(before);
    }
    return m;
}

diagnosis::ColumnGroup group_of(Eigen::Index first, Eigen::Index count, Eigen::MatrixXd shape) {
    diagnosis::ColumnGroup group;
    for (Eigen::Index k = 0; k < count; ++k) group.features.push_back(first + k);
    group.shape = std::move(shape);
    return group;
}

/// A full block, a table with mostly zeros, and a group over parts of both.
struct Bench {
    SeededNoise random{23};
    Eigen::VectorXd data = noise(random, 1).col(0);
    diagnosis::Design design{noise(random, 4), data, static_cast<double>(rows)};
    std::vector<std::size_t> groups;

    Bench() {
        const Eigen::Index full = design.add_features(noise(random, 5));
        const Eigen::Index table = design.add_features(hats(20));
        groups.push_back(design.add(group_of(full, 3, {})));
        groups.push_back(design.add(group_of(table, 20, noise(random, 6).topRows(20))));
        groups.push_back(
            design.add(group_of(full + 2, table + 8 - full - 2, noise(random, 3).topRows(11))));
        groups.push_back(design.add_beside(group_of(table, 20, {}), table));
    }
    Eigen::MatrixXd beside(std::size_t group) const {
        return design.projection().beside(design.columns(group));
    }
};

}  // namespace

TEST_CASE("products of groups are those of their columns, zeros or not", "[diagnosis]") {
    Bench b;
    for (const std::size_t m : b.groups)
        for (const std::size_t g : b.groups) {
            const Eigen::MatrixXd expected = b.beside(m).transpose() * b.beside(g);
            CHECK((b.design.cross({m}, {g}) - expected).norm() < 1e-9 * (1.0 + expected.norm()));
        }
}

TEST_CASE("what members leave is the product with the residual", "[diagnosis]") {
    Bench b;
    const std::vector<std::size_t> members{b.groups[2], b.groups[1]};
    const Eigen::VectorXd size = Eigen::VectorXd::LinSpaced(9, -1.0, 2.0);
    const Eigen::VectorXd residual = b.data - b.design.columns(members[0]) * size.head(3) -
                                     b.design.columns(members[1]) * size.tail(6);
    const Eigen::VectorXd left = b.design.left(members, size, b.groups);
    for (const std::size_t g : b.groups) {
        const Eigen::VectorXd expected = b.beside(g).transpose() * residual;
        CHECK((b.design.of_group(g, left) - expected).norm() < 1e-9 * (1.0 + expected.norm()));
        const Eigen::VectorXd asked = b.design.left(members, size, {g});
        CHECK((b.design.of_group(g, asked) - expected).norm() < 1e-9 * (1.0 + expected.norm()));
    }
}

TEST_CASE("models that share columns of the folds are left out as each alone", "[diagnosis]") {
    Bench b;
    diagnosis::Folds folds;
    for (Eigen::Index i = 0; i < rows; ++i) folds.group.push_back(static_cast<int>(i / 6));
    for (int block = 0; block < static_cast<int>(rows / 6); ++block)
        folds.fold.push_back(block % diagnosis::Folds::count);
    const std::vector<bool> used(static_cast<std::size_t>(rows), true);
    diagnosis::FoldColumns shared(b.design, {folds, used});
    for (const auto& members : {std::vector<std::size_t>{b.groups[2], b.groups[0]},
                                std::vector<std::size_t>{b.groups[1], b.groups[2]}}) {
        const diagnosis::Model model{members, {{0.7, 1.4}, 1.1}, 0.0};
        const std::vector<bool> all{true, true}, one{false, true};
        const diagnosis::LeftOut together(shared, model), alone(b.design, model, folds, used);
        CHECK(together.residual(all, all) == alone.residual(all, all));
        CHECK(together.residual(one, one) == alone.residual(one, one));
        // Against a fit of the rows that are left in.
        Eigen::VectorXd out = Eigen::VectorXd::Zero(rows);
        for (int f = 0; f < diagnosis::Folds::count; ++f) {
            Eigen::MatrixXd x(rows, 0);
            for (const Eigen::MatrixXd& part :
                 {b.design.known(), b.design.columns(members[0]), b.design.columns(members[1])}) {
                x.conservativeResize(Eigen::NoChange, x.cols() + part.cols());
                x.rightCols(part.cols()) = part;
            }
            Eigen::VectorXd precision = Eigen::VectorXd::Constant(x.cols(), 1.0 / 400.0);
            const Eigen::Index first = b.design.columns(members[0]).cols();
            precision.segment(4, first).setConstant(1.21 / 0.49);
            precision.tail(x.cols() - 4 - first).setConstant(1.21 / 1.96);
            Eigen::VectorXd weight = Eigen::VectorXd::Ones(rows);
            for (Eigen::Index i = 0; i < rows; ++i)
                if ((i / 6) % diagnosis::Folds::count == f) weight(i) = 0.0;
            Eigen::MatrixXd a = x.transpose() * weight.asDiagonal() * x;
            a.diagonal() += precision;
            const Eigen::VectorXd fit = a.llt().solve(x.transpose() * weight.cwiseProduct(b.data));
            out += (Eigen::VectorXd::Ones(rows) - weight).cwiseProduct(b.data - x * fit);
        }
        CHECK((together.residual(all, all) - out).norm() < 1e-9 * out.norm());
    }
}

TEST_CASE("members that are asked again are not factored again", "[diagnosis]") {
    Bench b;
    const estimation::Variances sizes{{1.0, 0.5}, 1.1};
    const std::vector<std::size_t> members{b.groups[0], b.groups[2]};
    const auto first = b.design.held(members, sizes);
    CHECK(b.design.held(members, sizes) == first);
    const Eigen::VectorXd mean = first->given.mean();
    for (const double tau : {0.1, 0.2, 0.3, 0.4}) {
        const auto other = b.design.held(members, {{tau, 0.5}, 1.1});
        CHECK(other != first);
        CHECK((other->given.mean() - mean).norm() > 1e-6);
    }
    const auto again = b.design.held(members, sizes);
    CHECK(again != first);
    CHECK((again->given.mean() - mean).norm() == 0.0);
}

// Angles that readings see through one arm are hidden, and stand as forms of one turn each.
TEST_CASE("a hidden form of a cause is not taken in place of another one", "[diagnosis]") {
    Bench bench;
    const diagnosis::Model model{{bench.groups[0]}, {{1.0}, 1.0}, 0.0};
    const auto forms = [&] {
        std::vector<std::size_t> list;
        for (const diagnosis::Offer& offer :
             diagnosis::OffersBeside(bench.design, model).other_forms(0))
            list.push_back(offer.group);
        std::sort(list.begin(), list.end());
        return list;
    };
    CHECK(forms() == std::vector{bench.groups[1], bench.groups[2], bench.groups[3]});
    bench.design.hide(bench.groups[2]);
    CHECK(forms() == std::vector{bench.groups[1], bench.groups[3]});
}

}  // namespace trunnion

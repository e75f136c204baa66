// Shares of causes that cancel, what a cause answers a contender, and the order of causes.
#include "diagnosis/verdict/shares.h"

#include <catch2/catch.hpp>
#include <set>

#include "diagnosis/search/model_weight.h"
#include "diagnosis/verdict/block_evidence.h"
#include "diagnosis/verdict/order.h"
#include "diagnosis/verdict/reply.h"
#include "tests/support/made_columns.h"

namespace trunnion {
using namespace made_columns;

TEST_CASE("causes that cancel divide what they do together", "[diagnosis]") {
    SeededNoise random(6);
    const Eigen::MatrixXd base = random_matrix(random, 2);
    const Eigen::MatrixXd line = base.col(0), place = base.col(0) + 0.1 * base.col(1);
    const Eigen::VectorXd data =
        10.0 * base.col(0) + 2.0 * base.col(1) + random_matrix(random, 1).col(0);
    diagnosis::Design design(random_matrix(random, 2), data, rows);
    for (const auto& [name, columns] : {std::pair("line", line), std::pair("place", place)})
        design.add(group_of(design, name, diagnosis::GroupKind::textbook, columns));
    const diagnosis::SearchSetting setting = diagnosis::search_setting(design, {0.0, 0.1});
    const diagnosis::Model model =
        diagnosis::tuned(design, setting, {{0, 1}, {{10.0, 20.0}, 1.0}, 0.0}, 3);
    const diagnosis::Sizes sizes = diagnosis::sizes_of(design, model, 1.0, {false, false});
    REQUIRE(sizes.along[0] < 0.0);  // what one does is taken back by the other
    const std::vector<double> shares = diagnosis::shares_of(design, model, sizes);
    CHECK(shares[0] + shares[1] == Approx(1.0).margin(0.02));
    CHECK(shares[0] == Approx(0.5).margin(0.1));
    // Each alone does nearly all of it, and neither is to be called none.
    CHECK(shares[1] == Approx(0.5).margin(0.1));
}

TEST_CASE("blocks that see a cause are counted by what it does in them", "[diagnosis]") {
    const diagnosis::Folds folds{{0, 0, 1, 1, 2, 2, 3, 3}, {0, 1, 2, 3}};
    diagnosis::Sizes sizes;
    sizes.parts = Eigen::MatrixXd::Zero(8, 3);
    sizes.remainder = Eigen::VectorXd::Zero(8);
    sizes.parts.col(0).setConstant(-2.0);
    sizes.parts(5, 1) = 3.0;
    CHECK(diagnosis::blocks_that_see(sizes, 0, folds) == Approx(4.0));
    CHECK(diagnosis::blocks_that_see(sizes, 1, folds) == Approx(1.0));
    CHECK(diagnosis::blocks_that_see(sizes, 2, folds) == 0.0);
    CHECK(diagnosis::seen_by(1.0) == Approx(2.0 / 3.0));
}

TEST_CASE("a cause answers a contender with what that found besides", "[diagnosis]") {
    SeededNoise random(8);
    const Eigen::MatrixXd base = random_matrix(random, 3);
    const Eigen::MatrixXd cause = base.col(0), twin = base.col(0) + 0.03 * base.col(1),
                          other = base.col(2);
    const Eigen::VectorXd data =
        6.0 * cause.col(0) + 0.5 * other.col(0) + random_matrix(random, 1).col(0);
    diagnosis::Design design(random_matrix(random, 2), data, rows);
    for (const auto& [name, columns] :
         {std::pair("cause", cause), std::pair("twin", twin), std::pair("besides", other)})
        design.add(group_of(design, name, diagnosis::GroupKind::textbook, columns));
    const diagnosis::SearchSetting setting = diagnosis::search_setting(design, {0.0, 0.1});
    const auto model_of = [&](std::vector<std::size_t> members, std::vector<double> sizes) {
        return diagnosis::tuned(design, setting, {std::move(members), {std::move(sizes), 1.0}, 0.0},
                                3);
    };
    const diagnosis::Model chosen = model_of({0}, {6.0}), contender = model_of({1, 2}, {6.0, 0.5});
    REQUIRE(diagnosis::weight_of(design, contender) > diagnosis::weight_of(design, chosen));
    const diagnosis::Model reply =
        diagnosis::reply_to({design, setting}, chosen, contender, "cause");
    CHECK(diagnosis::weight_of(design, reply) > diagnosis::weight_of(design, contender));
    CHECK(std::set<std::size_t>(reply.members.begin(), reply.members.end()) ==
          std::set<std::size_t>{0, 2});
}

TEST_CASE("most of the gap stands first, although its name is open", "[diagnosis]") {
    SeededNoise random(9);
    const Eigen::MatrixXd columns = random_matrix(random, 2);
    diagnosis::Design design(random_matrix(random, 2), columns.col(0), rows);
    for (const auto& [name, k] : {std::pair("large", 0), std::pair("Zsmall", 1)})
        design.add(group_of(design, name, diagnosis::GroupKind::textbook, columns.col(k)));
    const diagnosis::Model model{{0, 1}, {{1.0, 1.0}, 1.0}, 0.0};
    const auto first_of = [&](double share, const std::vector<std::string>& rivals) {
        diagnosis::Claim large, small;
        large.name = "large";
        large.share = share;
        large.probability = 0.3;
        large.rivals = rivals;
        small.position = 1;
        small.name = "Zsmall";
        small.share = 0.04;
        small.probability = 0.97;
        std::vector<diagnosis::Claim> claims{small, large};
        diagnosis::put_in_order(design, model, claims);
        return claims.front().name;
    };
    CHECK(first_of(0.8, {"twin"}) == "large");
    CHECK(first_of(0.4, {"twin"}) == "Zsmall");    // not most of it
    CHECK(first_of(0.8, {}) == "Zsmall");          // rather none than another name
    CHECK(first_of(0.8, {"Zsmall"}) == "Zsmall");  // its rival is claimed
}

}  // namespace trunnion

// Probabilities of claims on made-up columns, where it is known what can be told apart.
#include "diagnosis/verdict/claims.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "diagnosis/rules/rules.h"
#include "tests/support/made_columns.h"

namespace trunnion {
using namespace made_columns;
namespace {

/// The claims of a model whose members left-out readings support without doubt. `between`: they
/// hold between their places, too.
std::vector<diagnosis::Claim> claims_of(const diagnosis::Searching& search,
                                        const diagnosis::Challenged& found, bool between = true) {
    const std::vector<bool> none(found.model.members.size(), false);
    const diagnosis::Sizes sizes = diagnosis::sizes_of(search.design, found.model, 1.0, none);
    const std::vector<diagnosis::Support> support(found.model.members.size(),
                                                  {{50.0, 1000.0, 1.0, 1.0}});
    const std::vector<bool> interpolates(found.model.members.size(), between);
    return diagnosis::claims_of(search, found.model, sizes,
                                {support, found, folds_of_blocks(), interpolates, 1.0, 1.0});
}

/// A model of which the best contenders are far behind.
diagnosis::Challenged unrivalled(const diagnosis::Model& model) {
    diagnosis::Challenged found = diagnosis::unchallenged(model);
    found.ended = false;
    return found;
}

const diagnosis::Claim& claim_named(const std::vector<diagnosis::Claim>& claims,
                                    const std::string& name) {
    const auto at = std::find_if(claims.begin(), claims.end(),
                                 [&](const diagnosis::Claim& c) { return c.name == name; });
    REQUIRE(at != claims.end());
    return *at;
}

}  // namespace

TEST_CASE("a cause that works against the others is doubtful, however much evidence it has",
          "[diagnosis]") {
    SeededNoise random(4);
    const Eigen::MatrixXd base = random_matrix(random, 2);
    const Eigen::MatrixXd large = base.col(0), against = -0.9 * base.col(0) + 0.44 * base.col(1);
    const Eigen::VectorXd data =
        10.0 * large.col(0) + 4.0 * against.col(0) + random_matrix(random, 1).col(0);
    diagnosis::Design design(random_matrix(random, 2), data, rows);
    for (const auto& [name, columns] : {std::pair("large", large), std::pair("against", against)})
        design.add(group_of(design, name, diagnosis::GroupKind::textbook, columns));
    const diagnosis::SearchSetting setting = diagnosis::search_setting(design, {0.0, 0.1});
    const diagnosis::Model model =
        diagnosis::tuned(design, setting, {{0, 1}, {{10.0, 4.0}, 1.0}, 0.0}, 3);
    const auto claims = claims_of({design, setting}, unrivalled(model));
    CHECK(claim_named(claims, "large").probability > 0.95);
    CHECK(claim_named(claims, "against").probability <= 0.4);
}

TEST_CASE("a sure cause stays sure beside one that may be none", "[diagnosis]") {
    SeededNoise random(31);
    const Eigen::MatrixXd columns = random_matrix(random, 2);
    const Eigen::VectorXd data =
        8.0 * columns.col(0) + 0.17 * columns.col(1) + random_matrix(random, 1).col(0);
    diagnosis::Design design(random_matrix(random, 2), data, rows);
    for (const auto& [name, k] : {std::pair("sure", 0), std::pair("Zweak", 1)})
        design.add(group_of(design, name, diagnosis::GroupKind::textbook, columns.col(k)));
    const diagnosis::SearchSetting setting = diagnosis::search_setting(design, {0.0, 0.1});
    const diagnosis::Model model =
        diagnosis::tuned(design, setting, {{0, 1}, {{8.0, 0.2}, 1.0}, 0.0}, 3);
    const auto claims = claims_of({design, setting}, unrivalled(model));
    CHECK(claim_named(claims, "sure").probability > 0.98);
}

// An angular error seen through one tool length is a straightness with its bow: two causes in place
// of one, and neither of them alone.
// On 13 positions 15 degrees apart, a ripple of 8 degrees is a wave of 17 degrees, and the
// harmonics of the axis fit both.
TEST_CASE("a ripple that the positions do not resolve shares the probability", "[diagnosis]") {
    SeededNoise random(31);
    const std::vector<bool> used(rows, true);
    const Eigen::MatrixXd shapes = random_matrix(random, 6);
    for (const bool is_ripple : {true, false}) {
        const Eigen::MatrixXd ripple = shapes.leftCols(2) - shapes.middleCols(2, 2);
        Eigen::VectorXd data = random_matrix(random, 1).col(0);
        if (is_ripple)
            data += ripple * Eigen::Vector2d(1.5, -1.0);
        else
            data += shapes * Eigen::VectorXd::LinSpaced(6, -1.5, 1.5);
        diagnosis::Design design(random_matrix(random, 2), data, rows);
        design.add(group_of(design, "Z.straightness", diagnosis::GroupKind::textbook, shapes));
        diagnosis::ColumnGroup wave =
            group_of(design, "Z.cyclic", diagnosis::GroupKind::periodic, ripple);
        wave.effect = &straightness_of_Z();
        design.keep_as_rival(design.add(std::move(wave)));
        const diagnosis::SearchSetting setting = diagnosis::search_setting(design, {0.0, 0.1});
        const diagnosis::Model model =
            diagnosis::tuned(design, setting, {{0}, {{1.0}, 1.0}, 0.0}, 3);
        const auto claims = claims_of({design, setting}, unrivalled(model));
        const diagnosis::Claim& claim = claim_named(claims, "Z.straightness");
        INFO(is_ripple);
        CHECK((claim.probability < 0.4) == is_ripple);
        CHECK((claim.probability > 0.9) == !is_ripple);
        CHECK(claim.rivals.empty() == !is_ripple);
    }
}

TEST_CASE("a ripple that the places do not resolve is what a table gives at these", "[diagnosis]") {
    SeededNoise random(37);
    static const effects::Effect cyclic{
        {"Z.cyclic", effects::EffectKind::cyclic, Axis::Z}, "", "", "", "", {}, {}};
    const Eigen::MatrixXd shapes = random_matrix(random, 9);
    const Eigen::MatrixXd ripple = shapes.leftCols(2);
    const Eigen::VectorXd data =
        ripple * Eigen::Vector2d(1.5, -1.0) + random_matrix(random, 1).col(0);
    diagnosis::Design design(random_matrix(random, 2), data, rows);
    diagnosis::ColumnGroup table =
        group_of(design, "Z.positioning", diagnosis::GroupKind::table, shapes);
    table.table.motion = effects::EffectKind::positioning;
    design.add(std::move(table));
    diagnosis::ColumnGroup wave =
        group_of(design, "Z.cyclic", diagnosis::GroupKind::periodic, ripple);
    wave.effect = &cyclic;
    design.keep_as_rival(design.add(std::move(wave)));
    const diagnosis::SearchSetting setting = diagnosis::search_setting(design, {0.0, 0.1});
    const diagnosis::Model model = diagnosis::tuned(design, setting, {{0}, {{1.0}, 1.0}, 0.0}, 3);
    for (const bool between : {true, false}) {
        const auto claims = claims_of({design, setting}, unrivalled(model), between);
        const diagnosis::Claim& claim = claim_named(claims, "Z.positioning");
        INFO(between << ' ' << claim.probability);
        // Between its places the table may be a slow wave of the same values: as likely as not.
        CHECK((claim.probability == Approx(0.5).margin(0.01)) == between);
        CHECK((claim.probability > 0.9) == !between);
        CHECK(claim.rivals == std::vector<std::string>{"Z.cyclic"});
    }
}

TEST_CASE("a free form that two other causes imitate together is named by what they have in common",
          "[diagnosis]") {
    using diagnosis::GroupKind;
    SeededNoise random(11);
    const std::vector<bool> used(rows, true);
    const diagnosis::Folds folds = folds_of_blocks();
    for (const bool imitated : {true, false}) {
        const Eigen::MatrixXd shapes = random_matrix(random, 8), bow = random_matrix(random, 1);
        Eigen::MatrixXd one(rows, 9);
        one << shapes, bow;
        if (!imitated) one += 0.5 * random_matrix(random, 9);
        const Eigen::VectorXd size = 3.0 * Eigen::VectorXd::Random(9);
        const Eigen::VectorXd data = one * size + random_matrix(random, 1).col(0);
        diagnosis::Design design(random_matrix(random, 2), data, rows);
        diagnosis::ColumnGroup angular = group_of(design, "Z.angular", GroupKind::table, one);
        angular.table.motion = effects::EffectKind::angular;
        angular.log_prior -= 1.4;  // shared among its lengths
        const std::size_t held = design.add(angular);
        design.add(group_of(design, "Z.straightness", GroupKind::table, shapes));
        design.add(group_of(design, "Z.straightness", GroupKind::textbook, bow));
        const diagnosis::SearchSetting setting = diagnosis::search_setting(design, {0.0, 0.1});
        const diagnosis::Model model =
            diagnosis::tuned(design, setting, {{held}, {{2.0}, 1.0}, 0.0}, 3);
        const diagnosis::Searching search{design, setting};
        diagnosis::FoldColumns columns(design, {folds, used});
        const diagnosis::Challenged found = diagnosis::challenged(columns, setting, model);
        REQUIRE(found.model.members == model.members);
        const diagnosis::Claim claim =
            claim_named(claims_of(search, found), imitated ? "free form of Z" : "Z.angular");
        INFO(imitated << ": " << claim.probability);
        const auto names = [&](const char* rival) {
            return std::find(claim.rivals.begin(), claim.rivals.end(), rival) != claim.rivals.end();
        };
        CHECK(claim.probability > 0.95);
        const double own = diagnosis::probability_against(found.contenders.front());
        CHECK((own > 0.8) != imitated);
        CHECK(names("Z.straightness") == imitated);
        CHECK(names("Z.angular") == imitated);
        for (const auto& entry : design.groups()) CHECK_FALSE(entry.hidden);
    }
}

// On one line an angular error does what positioning or straightness does there, which are defined
// by what the line shows: only the angular error is left open.
TEST_CASE("an angular form that straightness does as well is a free form of its axis",
          "[diagnosis]") {
    using diagnosis::GroupKind;
    SeededNoise random(23);
    const Eigen::MatrixXd base = random_matrix(random, 2), shapes = random_matrix(random, 8);
    const Eigen::MatrixXd others = random_matrix(random, 8);
    for (const double apart : {0.0, 1.0}) {
        const Eigen::MatrixXd turned = (1.0 - apart) * shapes + apart * others;
        for (const char* held : {"Z.angular", "Z.straightness"}) {
            const bool angular = held == std::string("Z.angular");
            const Eigen::VectorXd data =
                2.0 * (angular ? turned : shapes).rowwise().sum() + random_matrix(random, 1).col(0);
            diagnosis::Design design(base, data, rows);
            diagnosis::ColumnGroup form = group_of(design, "Z.angular", GroupKind::table, turned);
            form.table.motion = effects::EffectKind::angular;
            design.add(form);
            design.add(group_of(design, "Z.straightness", GroupKind::table, shapes));
            const diagnosis::SearchSetting setting = diagnosis::search_setting(design, {0.0, 0.1});
            const diagnosis::Model model =
                diagnosis::tuned(design, setting, {{angular ? 0u : 1u}, {{2.0}, 1.0}, 0.0}, 3);
            const auto claims = claims_of({design, setting}, unrivalled(model));
            const bool open = angular && apart == 0.0;
            INFO(held << ", apart by " << apart << ": " << claims.front().name << " "
                      << claims.front().probability);
            CHECK(claims.front().name == (open ? "free form of Z" : held));
            CHECK((claims.front().probability > 0.9) == (open || apart > 0.0));
            CHECK(claims.front().rivals.empty() == (apart > 0.0));
        }
    }
}

TEST_CASE("what leaves twice the noise can be told apart, however well it imitates the rest",
          "[diagnosis]") {
    using diagnosis::GroupKind;
    SeededNoise random(29);
    const Eigen::MatrixXd base = random_matrix(random, 2), truth = random_matrix(random, 1);
    const Eigen::MatrixXd other = random_matrix(random, 1);
    const Eigen::VectorXd data = 500.0 * truth.col(0) + random_matrix(random, 1).col(0);
    for (const double apart : {0.001, 0.15}) {  // leaves 0.5 and 75 times the noise
        diagnosis::Design design(base, data, rows);
        design.add(group_of(design, "Z.straightness", GroupKind::textbook, 100.0 * truth));
        design.add(
            group_of(design, "X.scale", GroupKind::textbook, 100.0 * (truth + apart * other)));
        const diagnosis::SearchSetting setting = diagnosis::search_setting(design, {0.0, 0.1});
        const diagnosis::Model model =
            diagnosis::tuned(design, setting, {{0}, {{5.0}, 1.0}, 0.0}, 3);
        const auto claims = claims_of({design, setting}, unrivalled(model));
        INFO(apart);
        REQUIRE(claims.size() == 1);
        CHECK(claims.front().rivals.empty() == (apart > 0.1));
    }
}

TEST_CASE("a model that a contender beats gives way to it", "[diagnosis]") {
    SeededNoise random(12);
    const std::vector<bool> used(rows, true);
    const diagnosis::Folds folds = folds_of_blocks();
    const Eigen::MatrixXd truth = random_matrix(random, 1);
    const Eigen::VectorXd data = 4.0 * truth.col(0) + random_matrix(random, 1).col(0);
    diagnosis::Design design(random_matrix(random, 2), data, rows);
    const Eigen::MatrixXd like = truth + 0.2 * random_matrix(random, 1);
    design.add(group_of(design, "like", diagnosis::GroupKind::textbook, like));
    design.add(group_of(design, "truth", diagnosis::GroupKind::textbook, truth));
    const diagnosis::SearchSetting setting = diagnosis::search_setting(design, {0.0, 0.1});
    const diagnosis::Model model = diagnosis::tuned(design, setting, {{0}, {{4.0}, 1.0}, 0.0}, 3);
    diagnosis::FoldColumns columns(design, {folds, used});
    const diagnosis::Challenged found = diagnosis::challenged(columns, setting, model);
    CHECK(found.model.members == std::vector<std::size_t>{1});
    REQUIRE(found.contenders.size() == 1);
    CHECK(diagnosis::probability_against(found.contenders.front()) > 0.95);
}

TEST_CASE("table and textbook form of one cause are questioned together", "[diagnosis]") {
    using diagnosis::GroupKind;
    SeededNoise random(14);
    const std::vector<bool> used(rows, true);
    const diagnosis::Folds folds = folds_of_blocks();
    const Eigen::MatrixXd shapes = random_matrix(random, 4), bow = random_matrix(random, 1);
    const Eigen::VectorXd data = shapes * Eigen::VectorXd::Constant(4, 2.0) + 3.0 * bow.col(0) +
                                 random_matrix(random, 1).col(0);
    diagnosis::Design design(random_matrix(random, 2), data, rows);
    design.add(group_of(design, "Z.straightness", GroupKind::table, shapes));
    design.add(group_of(design, "Z.straightness", GroupKind::textbook, bow));
    const diagnosis::SearchSetting setting = diagnosis::search_setting(design, {0.0, 0.1});
    const diagnosis::Model model =
        diagnosis::tuned(design, setting, {{0, 1}, {{2.0, 3.0}, 1.0}, 0.0}, 3);
    diagnosis::FoldColumns columns(design, {folds, used});
    const diagnosis::Challenged found = diagnosis::challenged(columns, setting, model);
    REQUIRE(found.model.members == model.members);
    REQUIRE(found.contenders.size() == 2);
    for (const diagnosis::Contender& contender : found.contenders) {
        CHECK(contender.model.members.empty());  // without either form
        CHECK(contender.ahead == found.contenders.front().ahead);
        CHECK(diagnosis::probability_against(contender) > 0.99);
    }
}

TEST_CASE("a search that is ended questions no cause, rather than by half a contender",
          "[diagnosis]") {
    SeededNoise random(13);
    const std::vector<bool> used(rows, true);
    const diagnosis::Folds folds = folds_of_blocks();
    const Eigen::MatrixXd truth = random_matrix(random, 1);
    const Eigen::VectorXd data = 4.0 * truth.col(0) + random_matrix(random, 1).col(0);
    diagnosis::Design design(random_matrix(random, 2), data, rows);
    design.add(group_of(design, "truth", diagnosis::GroupKind::textbook, truth));
    diagnosis::SearchSetting setting = diagnosis::search_setting(design, {0.0, 0.1});
    const diagnosis::Model model = diagnosis::tuned(design, setting, {{0}, {{4.0}, 1.0}, 0.0}, 3);
    for (const int steps : {0, 1, 2, 3}) {
        int asked = 0;
        setting.go_on = [&] { return asked++ < steps; };
        diagnosis::FoldColumns columns(design, {folds, used});
        const diagnosis::Challenged found = diagnosis::challenged(columns, setting, model);
        CHECK(found.model.members == model.members);
        REQUIRE(found.contenders.size() == 1);
        CHECK(found.contenders.front().model.members.empty());
        CHECK(diagnosis::probability_against(found.contenders.front()) == 1.0);
        // Nothing was searched in its place: never sure.
        CHECK(claim_named(claims_of({design, setting}, found), "truth").probability <= 0.8);
    }
    CHECK(claim_named(claims_of({design, setting}, unrivalled(model)), "truth").probability > 0.95);
}

TEST_CASE(
    "the probability against a contender is that of the evidence, less what the blocks leave "
    "open",
    "[diagnosis]") {
    const auto of = [](double ahead, double predicted, double spread) {
        return diagnosis::probability_against({{}, ahead, predicted, spread});
    };
    CHECK(of(-3.0, 3.0, 0.0) == Approx(1.0 / (1.0 + std::exp(-3.0))));
    CHECK(of(0.0, 5.0, 2.0) == Approx(0.5));
    CHECK(of(-30.0, 30.0, 30.0) < 0.9);  // blocks that differ as much as their sum
    CHECK(of(-30.0, 30.0, 3.0) > 0.99);
    CHECK(of(-30.0, 300.0, 30.0) == Approx(of(-30.0, 30.0, 3.0)));
    CHECK(of(30.0, -30.0, 3.0) < 0.01);
    CHECK(diagnosis::probability_against({}) == 1.0);  // no contender
}

// A drift of 0.1 mm beside free zeros: 1 % of it is left, which is many times the noise.
TEST_CASE("an effect with keys is seen where the set-up takes up all but a hundredth of it",
          "[diagnosis]") {
    using diagnosis::GroupKind;
    SeededNoise random(41);
    const Eigen::MatrixXd known = random_matrix(random, 2);
    const Eigen::MatrixXd course = random_matrix(random, 1);
    for (const double left : {0.01, 1e-4}) {
        diagnosis::Design design(known, random_matrix(random, 1).col(0), rows);
        const Eigen::MatrixXd columns = 100.0 * known.col(0) + 100.0 * left * course;
        const std::size_t drift =
            design.add(group_of(design, "thermal.drift", GroupKind::periodic, columns));
        const std::size_t table = design.add(group_of(design, "Z.x", GroupKind::table, columns));
        INFO(left);
        CHECK(design.groups()[drift].visible() == (left == 0.01));
        CHECK_FALSE(design.groups()[table].visible());
    }
}

}  // namespace trunnion

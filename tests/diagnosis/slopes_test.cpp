// A straightness that is mostly slope, on made-up columns: ISO 230-1 takes straightness from the
// mean line, and the slope of that line is squareness.
#include <algorithm>
#include <catch2/catch.hpp>

#include "base/random.h"
#include "diagnosis/contenders.h"
#include "diagnosis/rules.h"

namespace trunnion {
namespace {

using diagnosis::GroupKind;

constexpr int rows = 400, blocks = 80;

/// Slope and bow in X, slope and bow in Z.
effects::Effect straightness_of_Y() {
    effects::Effect effect{
        {"Y.straightness", effects::EffectKind::straightness, Axis::Y}, "", "", "", "", {}, {}};
    effect.parameters.resize(4);
    effect.parameters[0].mean_line = effect.parameters[2].mean_line = true;
    return effect;
}

effects::Effect squareness_of(const std::string& plane) {
    return {{plane + ".squareness", effects::EffectKind::squareness, std::nullopt},
            "",
            "",
            "",
            "",
            std::vector<effects::EffectParameter>(1),
            {}};
}

struct Bench {
    SeededNoise random{21};
    effects::Effect straightness = straightness_of_Y(), xy = squareness_of("XY"),
                    yz = squareness_of("YZ");
    Eigen::MatrixXd shape = normals(4), table = normals(3);
    diagnosis::Folds folds;
    std::vector<bool> used = std::vector<bool>(rows, true);

    Bench() {
        for (int i = 0; i < rows; ++i) folds.group.push_back(i * blocks / rows);
        for (int b = 0; b < blocks; ++b) folds.fold.push_back(b % diagnosis::Folds::count);
    }
    Eigen::MatrixXd normals(Eigen::Index columns) {
        return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return random.normal(); });
    }
    diagnosis::ColumnGroup textbook(diagnosis::Design& design, const effects::Effect& effect,
                                    std::vector<std::size_t> parameters,
                                    const Eigen::MatrixXd& columns) const {
        diagnosis::ColumnGroup group;
        group.kind = GroupKind::textbook;
        group.name = effect.name;
        group.effect = &effect;
        group.parameters = std::move(parameters);
        group.log_prior = diagnosis::rules::effect_prior;
        const Eigen::Index first = design.add_features(columns);
        for (Eigen::Index k = 0; k < columns.cols(); ++k) group.features.push_back(first + k);
        return group;
    }
    /// Of straightness: 0 with slopes, 1 as a table, 2 without slopes; 3 and 4: squareness.
    diagnosis::Design design(const Eigen::Vector4d& size, double of_table = 0.4) {
        const Eigen::VectorXd data =
            shape * size + of_table * table.rowwise().sum() + normals(1).col(0);
        diagnosis::Design all(normals(2), data, rows);
        all.add(textbook(all, straightness, {0, 1, 2, 3}, shape));
        diagnosis::ColumnGroup free = textbook(all, straightness, {}, table);
        free.kind = GroupKind::table;
        free.table.motion = effects::EffectKind::straightness;
        free.table.axis.axis = Axis::Y;
        all.add(std::move(free));
        all.add(textbook(all, straightness, {1, 3}, shape(Eigen::all, {1, 3})));
        all.add(textbook(all, xy, {0}, shape.col(0)));
        all.add(textbook(all, yz, {0}, shape.col(2)));
        return all;
    }
};

/// Members of the model, sorted, after its causes were challenged.
std::vector<std::size_t> challenged_members(Bench& bench, const Eigen::Vector4d& size) {
    diagnosis::Design design = bench.design(size);
    const diagnosis::SearchSetting setting = diagnosis::search_setting(design, {0.0, 0.1});
    const diagnosis::Model model =
        diagnosis::tuned(design, setting, {{1, 0}, {{0.5, 5.0}, 1.0}, 0.0}, 3);
    diagnosis::FoldColumns columns(design, {bench.folds, bench.used});
    std::vector<std::size_t> members = diagnosis::challenged(columns, setting, model).model.members;
    std::sort(members.begin(), members.end());
    return members;
}

}  // namespace

TEST_CASE("a straightness of slopes alone gives way to squareness in both planes", "[diagnosis]") {
    Bench bench;
    // The table of the same cause is challenged with it, and comes first.
    CHECK(challenged_members(bench, {10.0, 0.0, 0.0, 0.0}) == std::vector<std::size_t>{1, 3});
    CHECK(challenged_members(bench, {10.0, 0.0, 2.0, 0.0}) == std::vector<std::size_t>{1, 3, 4});
}

TEST_CASE("a straightness with bows stays one", "[diagnosis]") {
    Bench bench;
    CHECK(challenged_members(bench, {5.0, 5.0, 4.0, 6.0}) == std::vector<std::size_t>{0, 1});
}

TEST_CASE("a slope is named as squareness also where another effect is the better rival",
          "[diagnosis]") {
    Bench bench;
    const Eigen::Vector4d size(0.6, 0.4, 0.1, 0.1);
    diagnosis::Design design = bench.design(size, 0.0);
    effects::Effect angular = bench.xy;
    angular.name = "Y.angular";
    angular.kind = effects::EffectKind::angular;
    const std::size_t imitator = design.add(
        bench.textbook(design, angular, {0}, bench.shape * size + 0.18 * bench.normals(1)));
    const diagnosis::SearchSetting setting = diagnosis::search_setting(design, {0.0, 0.1});
    const diagnosis::Model model = diagnosis::tuned(design, setting, {{0}, {{0.5}, 1.0}, 0.0}, 3);
    diagnosis::FoldColumns columns(design, {bench.folds, bench.used});
    const diagnosis::Challenged found = diagnosis::challenged(columns, setting, model);
    REQUIRE(found.model.members == std::vector<std::size_t>{0});
    const diagnosis::Contender& contender = found.contenders.front();
    CHECK(contender.model.members == std::vector<std::size_t>{imitator});
    CHECK(contender.slopes == std::vector<std::size_t>{3, 4});
}

}  // namespace trunnion

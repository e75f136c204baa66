// Several errors at once: turns of one slide are one error, names that are equal share one prior,
// and what two effects imitate is found beside many free forms, too.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "base/random.h"
#include "diagnosis/groups/angles_by_an_arm.h"
#include "diagnosis/rules/rules.h"
#include "diagnosis/search/search.h"

namespace trunnion {
namespace {

using diagnosis::GroupKind;

constexpr int rows_at_once = 400;

effects::Effect known_effect(const std::string& name, effects::EffectKind kind,
                             std::optional<Axis> axis, const std::vector<std::string>& parameters) {
    effects::Effect effect{{name, kind, axis}, "", "", "", "", {}, {}};
    for (const std::string& parameter : parameters) {
        effect.parameters.emplace_back();
        effect.parameters.back().name = parameter;
    }
    return effect;
}

struct AtOnce {
    SeededNoise random{7};
    effects::Effect angles_Z = known_effect("Z.angular", effects::EffectKind::angular, Axis::Z,
                                            {"EAZ_p1_rad", "EBZ_p1_rad"});
    effects::Effect angles_X =
        known_effect("X.angular", effects::EffectKind::angular, Axis::X, {"ECX_p1_rad"});
    effects::Effect angles_Y =
        known_effect("Y.angular", effects::EffectKind::angular, Axis::Y, {"ECY_p1_rad"});
    effects::Effect yz =
        known_effect("YZ.squareness", effects::EffectKind::squareness, std::nullopt, {"angle_rad"});
    effects::Effect zx =
        known_effect("ZX.squareness", effects::EffectKind::squareness, std::nullopt, {"angle_rad"});

    Eigen::MatrixXd normals(Eigen::Index columns) {
        return Eigen::MatrixXd::NullaryExpr(rows_at_once, columns, [&] { return random.normal(); });
    }
    diagnosis::ColumnGroup group(diagnosis::Design& design, const effects::Effect* effect,
                                 const std::string& name, const Eigen::MatrixXd& columns) {
        diagnosis::ColumnGroup group;
        group.kind = effect ? GroupKind::textbook : GroupKind::table;
        group.name = effect ? effect->name : name;
        group.effect = effect;
        group.log_prior = diagnosis::rules::effect_prior;
        group.table.motion = effects::EffectKind::straightness;
        group.table.axis.axis = Axis::Z;
        group.table.axis.name = "Z";
        const Eigen::Index first = design.add_features(columns);
        for (Eigen::Index k = 0; k < columns.cols(); ++k) {
            group.features.push_back(first + k);
            if (effect) group.parameters.push_back(static_cast<std::size_t>(k));
        }
        return group;
    }
};

/// Log priors of the visible groups of a name with so many columns.
std::vector<double> priors_of(const diagnosis::Design& design, const std::string& name,
                              Eigen::Index columns) {
    std::vector<double> list;
    for (const auto& entry : design.groups())
        if (!entry.hidden && entry.group.name == name && entry.group.columns() == columns)
            list.push_back(entry.group.log_prior);
    return list;
}

/// Names of the members, sorted.
std::vector<std::string> names_of(const diagnosis::Design& design, const diagnosis::Model& model) {
    std::vector<std::string> names;
    for (const std::size_t k : model.members) names.push_back(design.group(k).name);
    std::sort(names.begin(), names.end());
    return names;
}

}  // namespace

TEST_CASE("turns of a slide that the readings tell are one error together", "[diagnosis]") {
    // Through two arms that differ by little, each turn is nearly a squareness.
    for (const double apart : {0.0, 0.08}) {
        AtOnce bench;
        const Eigen::MatrixXd square = bench.normals(2);
        const Eigen::MatrixXd turns = square + apart * bench.normals(2);
        const Eigen::VectorXd data = 3.0 * turns.rowwise().sum() + bench.normals(1).col(0);
        diagnosis::Design design(bench.normals(2), data, rows_at_once);
        design.add(bench.group(design, &bench.yz, "", square.col(0)));
        design.add(bench.group(design, &bench.zx, "", square.col(1)));
        design.add(bench.group(design, &bench.angles_Z, "", turns));
        diagnosis::favour_motions_over_angles(design);
        INFO(apart);
        CHECK(priors_of(design, "Z.angular", 1).size() == 2);
        const std::vector<double> together = priors_of(design, "Z.angular", 2);
        REQUIRE(together.size() == (apart > 0.0 ? 1 : 0));
        const diagnosis::SearchSetting setting = diagnosis::search_setting(design, {0.0, 0.1});
        const diagnosis::Model model =
            diagnosis::settled(design, setting, diagnosis::searched(design, setting));
        if (apart > 0.0) {
            // Less than one effect, more than two of them.
            CHECK(together.front() < diagnosis::rules::effect_prior);
            CHECK(together.front() > 2.0 * diagnosis::rules::effect_prior);
            CHECK(names_of(design, model) == std::vector<std::string>{"Z.angular"});
        } else {
            CHECK(names_of(design, model) ==
                  std::vector<std::string>{"YZ.squareness", "ZX.squareness"});
        }
    }
}

TEST_CASE("angles of two axes that do the same share half the prior of its name", "[diagnosis]") {
    AtOnce bench;
    const Eigen::MatrixXd square = bench.normals(1), other = bench.normals(1);
    for (const bool same : {true, false}) {
        diagnosis::Design design(bench.normals(2), bench.normals(1).col(0), rows_at_once);
        design.add(bench.group(design, &bench.yz, "", square));
        design.add(bench.group(design, &bench.zx, "", other));
        design.add(bench.group(design, &bench.angles_X, "", square));
        design.add(bench.group(design, &bench.angles_Y, "", same ? square : other));
        diagnosis::favour_motions_over_angles(design);
        for (const char* name : {"X.angular", "Y.angular"}) {
            const std::vector<double> one = priors_of(design, name, 1);
            REQUIRE(one.size() == 1);
            CHECK(one.front() == Approx(diagnosis::rules::effect_prior +
                                        diagnosis::rules::by_an_arm - std::log(same ? 2.0 : 1.0)));
        }
    }
}

TEST_CASE("an effect that two others imitate is found beside many free forms", "[diagnosis]") {
    AtOnce bench;
    const Eigen::MatrixXd parts = bench.normals(2);
    std::vector<Eigen::MatrixXd> tables;
    Eigen::VectorXd data = 3.0 * parts.rowwise().sum() + bench.normals(1).col(0);
    for (int k = 0; k < 6; ++k) {
        tables.push_back(bench.normals(3));
        data += tables.back().rowwise().sum();
    }
    diagnosis::Design design(bench.normals(2), data, rows_at_once);
    diagnosis::Model model{{}, {{}, 1.0}, 0.0};
    const auto add = [&](diagnosis::ColumnGroup group, double tau) {
        model.members.push_back(design.add(std::move(group)));
        model.variances.tau.push_back(tau);
    };
    add(bench.group(design, &bench.yz, "", parts.col(0)), 3.0);
    add(bench.group(design, &bench.zx, "", parts.col(1)), 3.0);
    for (std::size_t k = 0; k < tables.size(); ++k)
        add(bench.group(design, nullptr, std::to_string(k) + ".straightness", tables[k]), 1.0);
    design.add(bench.group(design, &bench.angles_X, "", parts.rowwise().sum()));
    const diagnosis::SearchSetting setting = diagnosis::search_setting(design, {0.0, 0.1});
    const auto names = names_of(
        design, diagnosis::settled(design, setting, diagnosis::tuned(design, setting, model, 3)));
    CHECK(names.size() == 7);
    CHECK(names.back() == "X.angular");
}

}  // namespace trunnion

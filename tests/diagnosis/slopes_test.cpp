// ISO 230-1 takes straightness from the mean line of the measured travel; the slope of that line is
// squareness.
#include <algorithm>
#include <catch2/catch.hpp>

#include "base/random.h"
#include "diagnosis/diagnosis.h"
#include "diagnosis/groups/candidate_groups.h"
#include "diagnosis/rules/rules.h"
#include "diagnosis/search/solution.h"
#include "diagnosis/verdict/contenders.h"
#include "tests/support/campaign.h"
#include "tests/support/said.h"

namespace trunnion {
namespace {

using diagnosis::GroupKind;

constexpr int rows = 400, blocks = 80;

effects::Effect effect_of(const std::string& name, effects::EffectKind kind,
                          std::size_t parameters) {
    return {{name, kind, std::nullopt},
            "",
            "",
            "",
            "",
            std::vector<effects::EffectParameter>(parameters),
            {}};
}

struct Bench {
    SeededNoise random{21};
    effects::Effect angular = effect_of("Z.angular", effects::EffectKind::angular, 2),
                    xy = effect_of("XY.squareness", effects::EffectKind::squareness, 1),
                    yz = effect_of("YZ.squareness", effects::EffectKind::squareness, 1);
    Eigen::MatrixXd slopes = normals(2), table = normals(3);
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
    /// 0: a straightness of Y in free form, if there is one; then an angular error that does what
    /// both squarenesses do, and these.
    diagnosis::Design design(bool bowed) {
        Eigen::VectorXd data = 0.3 * slopes.rowwise().sum() + normals(1).col(0);
        if (bowed) data += 0.6 * table.rowwise().sum();
        diagnosis::Design all(normals(2), data, rows);
        diagnosis::ColumnGroup free = textbook(all, xy, {}, table);
        free.kind = GroupKind::table;
        free.name = "Y.straightness";
        free.effect = nullptr;
        free.table.motion = effects::EffectKind::straightness;
        free.table.axis.axis = Axis::Y;
        free.table.axis.name = "Y";
        if (bowed) all.add(std::move(free));
        all.add(textbook(all, angular, {0, 1}, slopes));
        all.add(textbook(all, xy, {0}, slopes.col(0)));
        all.add(textbook(all, yz, {0}, slopes.col(1)));
        return all;
    }
};

/// Names of the members, sorted, after all causes of a model were challenged.
std::vector<std::string> challenged_members(bool bowed) {
    Bench bench;
    diagnosis::Design design = bench.design(bowed);
    const diagnosis::SearchSetting setting = diagnosis::search_setting(design, {0.0, 0.1});
    const std::size_t angular = bowed ? 1 : 0;
    diagnosis::Model start{{angular}, {{0.3}, 1.0}, 0.0};
    if (bowed) {
        start.members.push_back(0);
        start.variances.tau.push_back(0.6);
    }
    const diagnosis::Model model = diagnosis::tuned(design, setting, start, 3);
    diagnosis::FoldColumns columns(design, {bench.folds, bench.used});
    std::vector<std::string> names;
    for (const std::size_t k : diagnosis::challenged(columns, setting, model).model.members)
        names.push_back(design.group(k).name);
    std::sort(names.begin(), names.end());
    return names;
}

/// Spheres far on one side of machine zero, at rotary positions all around.
records::ReadingTable one_sided(const setup::Setup& setup) {
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 40, 3);
    return table;
}

/// Slope of the mean line of some values over the positions of an axis.
double slope_of(const std::vector<double>& q, const std::vector<double>& value) {
    double mean_q = 0.0, mean_value = 0.0, up = 0.0, square = 0.0;
    for (std::size_t i = 0; i < q.size(); ++i) {
        mean_q += q[i] / static_cast<double>(q.size());
        mean_value += value[i] / static_cast<double>(q.size());
    }
    for (std::size_t i = 0; i < q.size(); ++i) {
        up += (q[i] - mean_q) * (value[i] - mean_value);
        square += (q[i] - mean_q) * (q[i] - mean_q);
    }
    return up / square;
}

}  // namespace

TEST_CASE("squareness beside a bowed axis is no second improbable cause", "[diagnosis]") {
    // One angular error does what two squarenesses do. Alone it is the one cause of two; an axis
    // that runs on a bowed line has both angles anyway.
    CHECK(challenged_members(false) == std::vector<std::string>{"Z.angular"});
    CHECK(challenged_members(true) ==
          std::vector<std::string>{"XY.squareness", "Y.straightness", "YZ.squareness"});
}

TEST_CASE("no form of straightness has a slope of its own", "[diagnosis]") {
    const setup::Setup setup = campaign::bc_setup();
    const records::ReadingTable table =
        campaign::measured(campaign::real_machine(setup), one_sided(setup), 1);
    const diagnosis::Prepared prepared = diagnosis::prepare(setup, table);
    const diagnosis::Whitener whitener(prepared.replay, prepared.blocks, {},
                                       prepared.base.sigma_mm);
    Eigen::MatrixXd known = prepared.base.columns;
    whitener.apply(known);
    const auto rows_read = static_cast<double>(prepared.replay.size());
    diagnosis::Design design(known, whitener.apply(prepared.base.residual_mm), rows_read);
    diagnosis::add_textbook_groups(design, prepared, whitener);
    std::vector<double> q;
    for (std::size_t i = 0; i < prepared.replay.size(); ++i)
        q.push_back(prepared.replay.sample(i).position[Axis::X]);
    int about_line = 0, about_zero = 0;
    for (const diagnosis::Design::Entry& entry : design.groups()) {
        const diagnosis::ColumnGroup& group = entry.group;
        if (group.name != "X.straightness") continue;
        REQUIRE(group.columns() == 2);
        for (int c = 0; c < 2; ++c) {
            const std::vector<double> p = diagnosis::values_in(group, Eigen::VectorXd::Unit(2, c));
            INFO(p[0] << " " << p[1] << " " << p[4] << " " << p[5]);
            const std::size_t first = c == 0 ? 0 : 4;  // EYX_p1 or EZX_p1
            CHECK(p[first + 1] == Approx(5e-3));
            if (p[first] == 0.0) {
                ++about_zero;
                continue;
            }
            ++about_line;
            std::vector<double> sideways_mm;
            for (const double x : q)
                sideways_mm.push_back(p[first] * x / 200.0 + p[first + 1] * x * x / 4e4);
            CHECK(std::abs(slope_of(q, sideways_mm)) < 1e-12);
        }
        // The columns on these rows are the derivatives by these values.
        const Eigen::MatrixXd columns =
            diagnosis::columns_on(prepared.replay, prepared.base.gradient, group);
        const Eigen::VectorXd by_values = [&] {
            Eigen::VectorXd sum = Eigen::VectorXd::Zero(columns.rows());
            const std::vector<double> p = diagnosis::values_in(group, Eigen::Vector2d(0.7, -1.3));
            for (std::size_t j = 0; j < p.size(); ++j)
                if (p[j] != 0.0)
                    sum += p[j] / group.effect->parameters[j].typical *
                           identification::effect_column(prepared.replay, prepared.base.gradient,
                                                         {*group.effect, group.effect->zeros(), j});
            return sum;
        }();
        CHECK((columns * Eigen::Vector2d(0.7, -1.3) - by_values).cwiseAbs().maxCoeff() < 1e-15);
    }
    CHECK(about_line == 2);
    CHECK(about_zero == 2);
}

TEST_CASE("a squareness seen on one side of machine zero is squareness", "[diagnosis]") {
    const setup::Setup setup = campaign::bc_setup();
    for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
        const setup::Setup truth =
            campaign::with_effect(campaign::real_machine(setup), "YZ.squareness: angle_rad=4e-5");
        diagnosis::DiagnosisOptions options;
        options.plan_next = false;
        const diagnosis::Diagnosis d =
            diagnosis::diagnose(setup, campaign::measured(truth, one_sided(setup), seed), options);
        INFO(seed << ": " << said(d));
        REQUIRE(!d.causes.empty());
        CHECK(d.causes.front().effect == "YZ.squareness");
        CHECK(d.causes.size() == 1);
    }
}

}  // namespace trunnion

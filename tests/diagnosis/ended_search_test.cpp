// A search that is asked to end: it says so, and what cannot be computed is not kept.
#include <catch2/catch.hpp>
#include <limits>

#include "diagnosis/diagnosis.h"
#include "diagnosis/search/solution.h"
#include "tests/support/campaign.h"

namespace trunnion {

TEST_CASE("a search that is asked to end says so, and fits no worse than the set-up alone",
          "[diagnosis]") {
    const setup::Setup setup = campaign::bc_setup();
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 14, 5);
    const records::ReadingTable readings = campaign::measured(
        campaign::with_effect(campaign::real_machine(setup), "C.backlash: gap_rad=2e-4"), table, 3);
    const auto asked = [&](int steps, int& count) {
        diagnosis::DiagnosisOptions options;
        options.plan_next = false;
        options.go_on = [&count, steps] { return count++ < steps; };
        return diagnosis::diagnose(setup, readings, options);
    };
    int all = 0;
    const diagnosis::Diagnosis whole = asked(std::numeric_limits<int>::max(), all);
    CHECK_FALSE(whole.unfinished);
    REQUIRE_FALSE(whole.causes.empty());
    CHECK(whole.causes.front().effect == "C.backlash");
    REQUIRE(all > 20);
    for (const int steps : {0, 1, 2, all / 4, all / 2, all - 3, all - 2, all - 1, all}) {
        int count = 0;
        const diagnosis::Diagnosis d = asked(steps, count);
        INFO(steps << " of " << all);
        CHECK(d.unfinished == (steps < all));
        CHECK(d.after_rms_um <= 1.001 * d.rms_um);
        if (steps == all) CHECK(d.causes.front().probability == whole.causes.front().probability);
    }
}

TEST_CASE("of a model that cannot be computed the members added last are dropped", "[diagnosis]") {
    SeededNoise random(5);
    constexpr Eigen::Index rows = 50;
    const auto noise = [&](Eigen::Index columns) {
        Eigen::MatrixXd m(rows, columns);
        for (double& v : m.reshaped()) v = random.normal();
        return m;
    };
    const Eigen::MatrixXd known = noise(2), cause = noise(1), other = noise(1);
    diagnosis::Design design(known, 3.0 * cause.col(0) + other.col(0) + noise(1).col(0), rows);
    for (const Eigen::MatrixXd& column : {cause, other}) {
        diagnosis::ColumnGroup group;
        group.name = design.groups().empty() ? "cause" : "other";
        group.features = {design.add_features(column)};
        design.add(std::move(group));
    }
    const diagnosis::SearchSetting setting = diagnosis::search_setting(design, {0.0, 0.1});
    const diagnosis::Model sound =
        diagnosis::tuned(design, setting, {{0, 1}, {{3.0, 1.0}, 1.0}, 0.0}, 2);
    const auto kept = [&](const diagnosis::Model& model) {
        const diagnosis::Model left = diagnosis::computable(design, setting, model);
        CHECK(diagnosis::solved(design, left).mean.allFinite());
        CHECK(std::isfinite(diagnosis::evidence(design, left)));
        return left.members;
    };
    CHECK(kept(sound) == sound.members);
    diagnosis::Model model = sound;
    model.variances.tau[1] = std::nan("");
    CHECK(kept(model) == std::vector<std::size_t>{0});
    model.variances.tau[0] = std::nan("");
    CHECK(kept(model).empty());
    for (const double nu : {std::nan(""), 1e-200}) {
        model = sound;
        model.variances.nu = nu;
        CHECK(kept(model).empty());
    }
    model = sound;
    model.score = std::nan("");
    CHECK(kept(model).empty());
}

}  // namespace trunnion

// The search of a key between the values of its grid.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>

#include "identification/identify.h"
#include "identification/keys.h"
#include "tests/support/campaign.h"

namespace trunnion {

TEST_CASE("a key is refined inside its interval, to the value that explains most",
          "[identification]") {
    const setup::Setup setup = campaign::bc_setup();
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 60, 3);
    const effects::Catalogue catalogue =
        effects::make_catalogue(setup, effects::extent_of(setup, table));
    effects::Effect drift = *effects::find_effect(catalogue, "thermal.drift");
    const std::vector<double> grid = drift.parameters[3].grid;
    double least = 1e300, most = 0.0;  // of the keys that are looked at
    const effects::EffectFunction plain = drift.add;
    drift.add = [&](const AxisSample& sample, const emulator::Contact& contact,
                    std::span<const double> value, kinematics::Perturbation& out) {
        least = std::min(least, value[3]);
        most = std::max(most, value[3]);
        plain(sample, contact, value, out);
    };
    for (std::size_t k = 2; k + 2 < grid.size(); ++k)
        for (const double share : {0.2, 0.5, 0.8}) {
            const double tau_s = grid[k] + share * (grid[k + 1] - grid[k]);
            const setup::Setup truth = campaign::with_effect(
                setup, "thermal.drift: d_mm=[0.01, 0, 0.03], tau_s=" + std::to_string(tau_s));
            const records::ReadingTable readings = campaign::measured(truth, table, 1, 0.0);
            const emulator::Replay replay(setup, readings);
            const identification::BaseModel base =
                identification::fit_base(setup, readings, replay, catalogue, {});
            std::vector<double> start = drift.zeros();
            start[3] = grid[share < 0.5 ? k : k + 1];
            least = 1e300, most = 0.0;
            const std::vector<double> keys =
                identification::refine_keys(replay, base, drift, start, base.residual_mm);
            INFO(tau_s << " from " << start[3]);
            CHECK(keys[3] == Approx(tau_s).epsilon(0.01));
            // The first interval reaches to the next values of the grid, a second one beyond them.
            CHECK(least >= grid[k - 1] * 0.999);
            CHECK(most <= grid[k + 2] * 1.001);
        }
}

TEST_CASE("keys optimised together stay within half the first and twice the last grid value",
          "[identification]") {
    const setup::Setup setup = campaign::bc_setup();
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 60, 3);
    const effects::Catalogue catalogue =
        effects::make_catalogue(setup, effects::extent_of(setup, table));
    const effects::Effect& drift = *effects::find_effect(catalogue, "thermal.drift");
    const std::vector<double>& grid = drift.parameters[3].grid;
    const double first = grid.front(), last = grid.back();
    struct Case {
        double start, truth, found;
    };
    for (const Case& c : {Case{first, 0.7 * first, 0.7 * first},
                          {last, 1.5 * last, 1.5 * last},
                          {first, 0.2 * first, 0.5 * first},
                          {last, 4.0 * last, 2.0 * last}}) {
        const setup::Setup truth = campaign::with_effect(
            setup, fmt::format("thermal.drift: d_mm=[0.01, 0, 0.03], tau_s={}", c.truth));
        const records::ReadingTable readings = campaign::measured(truth, table, 1, 0.0);
        const emulator::Replay replay(setup, readings);
        const identification::BaseModel base =
            identification::fit_base(setup, readings, replay, catalogue, {});
        identification::KeyedEffect keyed{&drift, drift.zeros(), {3}};
        keyed.values[3] = c.start;
        std::vector<identification::KeyedEffect> effects{keyed};
        identification::refine_together(replay, base, effects);
        INFO(c.truth << " from " << c.start);
        CHECK(effects[0].values[3] == Approx(c.found).epsilon(0.01));
    }
}

TEST_CASE("a slip is dated to the middle between the readings before and after it",
          "[identification]") {
    const setup::Setup setup = campaign::bc_setup();
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 60, 3);
    const effects::Catalogue catalogue =
        effects::make_catalogue(setup, effects::extent_of(setup, table));
    const effects::Effect& moved = *effects::find_effect(catalogue, "artefact.moved");
    for (const std::size_t row : {80U, 150U, 220U}) {
        const double slip_s = table.rows[row].time_s - 1.0;
        double before_s = 0.0, after_s = 1e9;
        for (const records::Reading& r : table.rows) {
            if (r.device == records::Device::none || r.feature != "S1") continue;
            if (r.time_s < slip_s)
                before_s = std::max(before_s, r.time_s);
            else
                after_s = std::min(after_s, r.time_s);
        }
        const setup::Setup truth = campaign::with_effect(
            setup,
            fmt::format("artefact.moved: shift_mm=[0.02, 0.01, -0.015], artefact=0, time_s={}",
                        slip_s));
        const records::ReadingTable readings = campaign::measured(truth, table, 1, 0.0);
        const emulator::Replay replay(setup, readings);
        const identification::BaseModel base =
            identification::fit_base(setup, readings, replay, catalogue, {});
        const std::vector<double> keys =
            identification::search_keys(replay, base, moved, base.residual_mm);
        INFO(before_s << " to " << after_s);
        CHECK(keys[3] == 0.0);
        CHECK(keys[4] == Approx(0.5 * (before_s + after_s)).margin(0.01 * (after_s - before_s)));
    }
}

}  // namespace trunnion

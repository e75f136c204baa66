// The search of a key between the values of its grid.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>

#include "identification/identify.h"
#include "identification/keys.h"
#include "tests/support/campaign.h"
#include "tests/support/laser_lines.h"

namespace trunnion {
namespace {

/// Spheres touched at 60 poses of a machine without errors, and the catalogue for their time.
struct Map {
    setup::Setup setup = campaign::bc_setup();
    records::ReadingTable table = touched(setup);
    effects::Catalogue catalogue = effects::make_catalogue(setup, effects::extent_of(setup, table));

    static records::ReadingTable touched(const setup::Setup& setup) {
        records::ReadingTable table = campaign::empty_table(setup);
        campaign::add_sphere_map(table, setup, 60, 3);
        return table;
    }
    const effects::Effect& effect(const char* name) const {
        return *effects::find_effect(catalogue, name);
    }
};

/// Noiseless readings of a machine with one effect, and the fit of the base to them.
struct Fitted {
    records::ReadingTable readings;
    emulator::Replay replay;
    identification::BaseModel base;

    Fitted(const Map& map, const std::string& injection)
        : readings(
              campaign::measured(campaign::with_effect(map.setup, injection), map.table, 1, 0.0)),
          replay(map.setup, readings),
          base(identification::fit_base(map.setup, readings, replay, map.catalogue, {})) {}
};

}  // namespace

TEST_CASE("a key is refined inside its interval, to the value that explains most",
          "[identification]") {
    const Map map;
    effects::Effect drift = map.effect("thermal.drift");
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
            const Fitted fit(map,
                             fmt::format("thermal.drift: d_mm=[0.01, 0, 0.03], tau_s={}", tau_s));
            std::vector<double> start = drift.zeros();
            start[3] = grid[share < 0.5 ? k : k + 1];
            least = 1e300, most = 0.0;
            const std::vector<double> keys = identification::refine_keys(
                fit.replay, fit.base, drift, start, fit.base.residual_mm);
            INFO(tau_s << " from " << start[3]);
            CHECK(keys[3] == Approx(tau_s).epsilon(0.01));
            // The first interval reaches to the next values of the grid, a second one beyond them.
            CHECK(least >= grid[k - 1] * 0.999);
            CHECK(most <= grid[k + 2] * 1.001);
        }
}

TEST_CASE("keys optimised together stay within half the first and twice the last grid value",
          "[identification]") {
    const Map map;
    const effects::Effect& drift = map.effect("thermal.drift");
    const std::vector<double>& grid = drift.parameters[3].grid;
    const double first = grid.front(), last = grid.back();
    struct Case {
        double start_s, truth_s, found_s;
    };
    for (const Case& c : {Case{first, 0.7 * first, 0.7 * first},
                          {last, 1.5 * last, 1.5 * last},
                          {first, 0.2 * first, 0.5 * first},
                          {last, 4.0 * last, 2.0 * last}}) {
        const Fitted fit(map,
                         fmt::format("thermal.drift: d_mm=[0.01, 0, 0.03], tau_s={}", c.truth_s));
        identification::KeyedEffect keyed{&drift, drift.zeros(), {3}};
        keyed.values[3] = c.start_s;
        std::vector<identification::KeyedEffect> effects{keyed};
        identification::refine_together(fit.replay, fit.base, effects);
        INFO(c.truth_s << " from " << c.start_s);
        CHECK(effects[0].values[3] == Approx(c.found_s).epsilon(0.01));
    }
}

TEST_CASE("a slip is dated to the middle between the readings before and after it",
          "[identification]") {
    const Map map;
    const effects::Effect& moved = map.effect("artefact.moved");
    for (const std::size_t row : {80U, 150U, 220U}) {
        const double slip_s = map.table.rows[row].time_s - 1.0;
        double before_s = 0.0, after_s = 1e9;
        for (const records::Reading& r : map.table.rows) {
            if (r.device == records::Device::none || r.feature != "S1") continue;
            if (r.time_s < slip_s)
                before_s = std::max(before_s, r.time_s);
            else
                after_s = std::min(after_s, r.time_s);
        }
        const Fitted fit(
            map, fmt::format("artefact.moved: shift_mm=[0.02, 0.01, -0.015], artefact=0, time_s={}",
                             slip_s));
        const std::vector<double> keys =
            identification::search_keys(fit.replay, fit.base, moved, fit.base.residual_mm);
        INFO(before_s << " to " << after_s);
        CHECK(keys[3] == 0.0);
        CHECK(keys[4] == Approx(0.5 * (before_s + after_s)).margin(0.01 * (after_s - before_s)));
    }
}

TEST_CASE("a key some values of the grid away is found, below and above", "[identification]") {
    const Map map;
    const effects::Effect& drift = map.effect("thermal.drift");
    const std::vector<double>& grid = drift.parameters[3].grid;
    const std::size_t middle = grid.size() / 2;
    const Fitted fit(
        map, fmt::format("thermal.drift: d_mm=[0.01, 0, 0.03], tau_s={}", 1.05 * grid[middle]));
    for (const std::size_t from : {middle - 3, middle - 2, middle + 3, middle + 4}) {
        std::vector<double> start = drift.zeros();
        start[3] = grid[from];
        INFO(grid[from] << " to " << 1.05 * grid[middle]);
        CHECK(identification::refine_keys(fit.replay, fit.base, drift, start,
                                          fit.base.residual_mm)[3] ==
              Approx(1.05 * grid[middle]).epsilon(0.01));
    }
}

// Over a metre a period of 10 mm that is wrong by 1 % is a turn off: what it explains has many
// peaks between the values of the grid.
TEST_CASE("a period is refined on the highest peak of a long travel", "[identification]") {
    const setup::Setup setup = laser_lines::stage();
    records::ReadingTable table = laser_lines::empty_table();
    laser_lines::add_runs(table, {"L", Axis::X, 0.0, 17.3, 60});
    const effects::Catalogue catalogue =
        effects::make_catalogue(setup, effects::extent_of(setup, table));
    const effects::Effect& ripple = *effects::find_effect(catalogue, "X.cyclic");
    const std::vector<double>& grid = ripple.parameters[2].grid;
    for (const double period_mm : {8.0, 10.0, 16.0, 25.4}) {
        const records::ReadingTable readings = campaign::measured(
            campaign::with_effect(setup, fmt::format("X.cyclic: cos_mm=0.003, sin_mm=0.002, "
                                                     "period_mm={}",
                                                     period_mm)),
            table, 1, 0.0);
        const emulator::Replay replay(setup, readings);
        const identification::BaseModel base =
            identification::fit_base(setup, readings, replay, catalogue, {});
        const auto above = std::upper_bound(grid.begin(), grid.end(), period_mm);
        for (const double from : {*(above - 2), *(above - 1), *above, *(above + 1)}) {
            std::vector<double> start = ripple.zeros();
            start[2] = from;
            INFO(period_mm << " from " << from);
            CHECK(identification::refine_keys(replay, base, ripple, start, base.residual_mm)[2] ==
                  Approx(period_mm).epsilon(2e-4));
        }
    }
}

}  // namespace trunnion

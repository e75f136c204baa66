// Simulate with known errors, identify: the same numbers, and what cannot be told apart is named.
#include "identification/identify.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "base/alarm.h"
#include "identification/monte_carlo.h"
#include "tests/support/campaign.h"

namespace trunnion {
namespace {

double found(const identification::Identification& result, const std::string& name) {
    for (const identification::FitParameter& p : result.parameters)
        if (p.name == name) return p.value;
    FAIL("no parameter " + name);
    return 0.0;
}

}  // namespace

TEST_CASE("eight location errors come back as they went in", "[identification]") {
    const setup::Setup setup = campaign::bc_setup(), truth = campaign::real_machine(setup);
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 60, 3);
    const identification::Identification exact =
        identification::identify(setup, campaign::measured(truth, table, 1, 0.0), {});
    REQUIRE(exact.inseparable.empty());
    REQUIRE(exact.rms_after_um < 1e-4);
    for (const char* name : {"EX0B", "EZ0B", "EA0B", "EC0B", "EX0C", "EY0C", "EA0C", "EB0C"}) {
        const double expected = truth.machine.errors.location(*kinematics::parse_error_name(name));
        const std::string key = std::string(name) + (name[1] < 'D' ? "_rad" : "_mm");
        INFO(name);
        REQUIRE(found(exact, key) == Approx(expected).margin(name[1] < 'D' ? 1e-9 : 1e-7));
    }
    const identification::Identification noisy =
        identification::identify(setup, campaign::measured(truth, table, 1), {});
    for (const identification::FitParameter& p : noisy.parameters) {
        INFO(p.name);
        REQUIRE(std::abs(p.value - found(exact, p.name)) < 4.5 * p.sigma);
    }
    REQUIRE(noisy.rms_after_um == Approx(0.8).epsilon(0.12));
}

TEST_CASE("simulated repetitions scatter as the covariance says", "[identification]") {
    const setup::Setup setup = campaign::bc_setup(), truth = campaign::real_machine(setup);
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 24, 3);
    const records::ReadingTable readings = campaign::measured(truth, table, 1);
    identification::Identification a = identification::identify(setup, readings, {}), b = a, c = a;
    const auto repeated = [&](int runs, std::uint64_t seed, int first, int step, int last) {
        const identification::RepetitionPlan plan{
            runs, seed, first, step, 2U, [last](int done) { return done < last; }};
        return identification::repeat_identification(setup, readings, {}, plan, a);
    };
    const auto all = repeated(60, 5, 0, 1, 60);
    identification::enter_spread(all, a);
    // Two shards, put together.
    std::vector<identification::Repetition> halves = repeated(60, 5, 0, 2, 60);
    for (const auto& r : repeated(60, 5, 1, 2, 60)) halves.push_back(r);
    std::sort(halves.begin(), halves.end(),
              [](const auto& x, const auto& y) { return x.index < y.index; });
    identification::enter_spread(halves, b);
    identification::enter_spread(repeated(60, 6, 0, 1, 60), c);
    const auto cut = repeated(60, 5, 0, 1, 9);
    CHECK(cut.size() >= 9);
    CHECK(cut.size() <= 10);  // the other thread may end one more
    CHECK(cut[3].off == all[3].off);
    identification::Identification short_run = a;
    identification::enter_spread({all[0]}, short_run);
    CHECK(short_run.parameters[0].sigma_monte_carlo == a.parameters[0].sigma_monte_carlo);
    for (std::size_t k = 0; k < a.parameters.size(); ++k) {
        INFO(a.parameters[k].name);
        CHECK(a.parameters[k].sigma_monte_carlo == b.parameters[k].sigma_monte_carlo);
        CHECK(a.parameters[k].sigma_monte_carlo != c.parameters[k].sigma_monte_carlo);
        // 60 repetitions know a deviation to 9 %; four times that.
        CHECK(a.parameters[k].sigma_monte_carlo == Approx(a.parameters[k].sigma).epsilon(0.36));
    }
}

TEST_CASE("an identified setup loads again and predicts the readings", "[identification]") {
    const setup::Setup setup = campaign::bc_setup(), truth = campaign::real_machine(setup);
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 40, 3);
    campaign::add_ballbar(table, setup);
    const records::ReadingTable readings = campaign::measured(truth, table, 1, 0.0);
    const identification::Identification result = identification::identify(setup, readings, {});
    std::vector<std::string> notes;
    const setup::Setup again =
        setup::parse_setup(setup::format_setup(result.setup), "again.toml", notes);
    const records::ReadingTable prediction =
        emulator::predicted(again, table, effects::active_models(again));
    for (std::size_t i = 0; i < table.rows.size(); ++i)
        if (readings.rows[i].value_mm)
            REQUIRE(*prediction.rows[i].value_mm ==
                    Approx(*readings.rows[i].value_mm).margin(1e-6));
}

TEST_CASE("a ballbar alone cannot place axes and cup: three groups are named", "[identification]") {
    const setup::Setup setup = campaign::bc_setup(), truth = campaign::real_machine(setup);
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_ballbar(table, setup);
    const identification::Identification result =
        identification::identify(setup, campaign::measured(truth, table, 1), {});
    REQUIRE(result.inseparable.size() == 3);
    REQUIRE(result.rms_after_um == Approx(0.3).epsilon(0.1));
    for (const identification::Inseparable& group : result.inseparable)
        REQUIRE(group.names.size() == group.direction.size());
}

TEST_CASE("a wrong 1970x store shows four of its six numbers", "[identification]") {
    setup::Setup setup = campaign::bc_setup();
    setup.model.modelled = {};
    const setup::Setup truth = campaign::with_effect(
        setup, "pivot.p1970x: dp_mm=[0.02, 0.01, -0.03], dd_mm=[0.015, -0.02, 0.01]");
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 60, 8);
    const identification::Identification result =
        identification::identify(setup, campaign::measured(truth, table, 2), {"pivot.p1970x"});
    REQUIRE(result.inseparable.size() == 2);
    double dp_x = 0.0, sum_y = 0.0;
    for (const identification::FitParameter& p : result.parameters) {
        if (p.name == "dp_mm" && p.component == 0) dp_x = p.value;
        if ((p.name == "dp_mm" || p.name == "dd_mm") && p.component == 1) sum_y += p.value;
    }
    REQUIRE(dp_x == Approx(0.02).margin(1e-3));
    REQUIRE(sum_y == Approx(-0.01).margin(1e-3));
}

TEST_CASE("a calibrated value enters as a prior", "[identification]") {
    setup::Setup setup = campaign::bc_setup();
    const setup::Setup truth = campaign::real_machine(setup);
    setup.model.calibration["EX0B"] = {0.012, 1e-5};
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_ballbar(table, setup);
    const identification::Identification result =
        identification::identify(setup, campaign::measured(truth, table, 1), {});
    REQUIRE(found(result, "EX0B_mm") == Approx(0.012).margin(5e-5));
    REQUIRE(result.inseparable.size() == 2);
}

TEST_CASE("keys are searched: time constant of a drift", "[identification]") {
    const setup::Setup setup = campaign::bc_setup();
    const setup::Setup truth = campaign::with_effect(
        campaign::real_machine(setup), "thermal.drift: d_mm=[0.01, 0, 0.03], tau_s=700");
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 120, 3);
    const identification::Identification result = identification::identify(
        setup, campaign::measured(truth, table, 1), {"location", "thermal.drift"});
    REQUIRE(found(result, "tau_s") == Approx(700).epsilon(0.1));
    REQUIRE(result.rms_after_um == Approx(0.8).epsilon(0.1));
}

TEST_CASE("a key beyond the last one of its grid is found", "[identification]") {
    const setup::Setup setup = campaign::bc_setup();
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 120, 3);
    for (records::Reading& row : table.rows) row.time_s *= 20.0;
    const effects::Catalogue catalogue =
        effects::make_catalogue(setup, effects::extent_of(setup, table));
    const auto& parameters = effects::find_effect(catalogue, "thermal.drift")->parameters;
    const std::vector<double>& grid =
        std::find_if(parameters.begin(), parameters.end(), [](const auto& p) {
            return p.name == "tau_s";
        })->grid;
    const double tau_s = 1.3 * grid.back();
    const setup::Setup truth = campaign::with_effect(
        setup, "thermal.drift: d_mm=[0.05, 0, 0.1], tau_s=" + std::to_string(tau_s));
    const identification::Identification result = identification::identify(
        setup, campaign::measured(truth, table, 1, 0.0), {"thermal.drift"});
    CHECK(found(result, "tau_s") == Approx(tau_s).epsilon(1e-3));
}

TEST_CASE("the sigma of a key is how far it scatters", "[identification]") {
    const setup::Setup setup = campaign::bc_setup();
    const setup::Setup truth =
        campaign::with_effect(setup, "thermal.drift: d_mm=[0.01, 0, 0.03], tau_s=700");
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 60, 3);
    double square = 0.0;
    constexpr int runs = 12;
    for (int seed = 1; seed <= runs; ++seed) {
        const identification::Identification result = identification::identify(
            setup, campaign::measured(truth, table, static_cast<unsigned>(seed)),
            {"thermal.drift"});
        for (const identification::FitParameter& p : result.parameters) {
            if (p.name != "tau_s") continue;
            REQUIRE(p.sigma > 0.0);
            square += std::pow((p.value - 700.0) / p.sigma, 2) / runs;
        }
    }
    CHECK(square > 0.3);
    CHECK(square < 2.5);
}

TEST_CASE("readings of another machine or in other units are refused", "[identification]") {
    const setup::Setup setup = campaign::bc_setup();
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 20, 3);
    records::ReadingTable readings = campaign::measured(setup, table, 1);
    records::ReadingTable far = readings;
    far.rows[5].value_mm = 100.0;
    REQUIRE_THROWS_AS(identification::identify(setup, far, {}), InputError);
    records::ReadingTable other = readings;
    other.axes = {Axis::X, Axis::Y, Axis::Z, Axis::A, Axis::C};
    REQUIRE_THROWS_AS(identification::identify(setup, other, {}), InputError);
    records::ReadingTable blank = readings;
    blank.rows[5].value_mm.reset();
    REQUIRE_THROWS_AS(identification::identify(setup, blank, {}), InputError);
    REQUIRE_THROWS_AS(identification::identify(setup, readings, {"C.wobble"}), InputError);
}

}  // namespace trunnion

// Parameters at the ends of what is searched: the largest lags, the shortest and longest periods,
// and axes that stood in too few places for a period.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "diagnosis/diagnosis.h"
#include "diagnosis/groups/ripples.h"
#include "tests/support/campaign.h"
#include "tests/support/diagnosed.h"
#include "tests/support/said.h"

namespace trunnion {
namespace {

double value_of(const diagnosis::Cause& cause, const std::string& name) {
    for (const identification::FitParameter& p : cause.parameters)
        if (p.name == name) return p.value;
    return std::nan("");
}

/// X to and fro over 120 mm, seen by its own encoder, 5 ms apart.
records::ReadingTable servo_log(const setup::Setup& setup) {
    records::ReadingTable table = campaign::empty_table(setup);
    for (int k = 0; k < 1200; ++k) {
        records::Reading row;
        row.test = "log";
        row.device = records::Device::axis;
        row.feature = "X";
        row.time_s = 0.005 * k;
        row.commanded[Axis::X] = 60.0 * std::sin(2.0 * pi * row.time_s / 4.0);
        table.rows.push_back(row);
    }
    return table;
}

/// Poses whose tilting axis stands in `count` even places over 160 degrees.
records::ReadingTable map_in_places(const setup::Setup& setup, int count, std::uint64_t seed) {
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 90, seed);
    const double step_rad = rad_from_deg(160.0) / (count - 1);
    for (records::Reading& row : table.rows) {
        double& tilt = row.commanded[Axis::B];
        if (row.device != records::Device::sphere) continue;
        const double at = std::round((tilt + rad_from_deg(80.0)) / step_rad);
        tilt = std::clamp(at, 0.0, count - 1.0) * step_rad - rad_from_deg(80.0);
        campaign::aim(row, setup, setup.find_artefact(row.feature)->center_W_mm,
                      setup.probe->tip_S_mm);
    }
    return table;
}

}  // namespace

TEST_CASE("a lag is found up to 50 ms and beyond it, with its size", "[diagnosis][bounds]") {
    setup::Setup setup = campaign::bc_setup();
    setup.model.modelled = {};
    setup.model.allow_large = true;
    for (const double lag_s : {0.0005, 0.02, 0.049, 0.05, 0.051}) {
        const setup::Setup truth =
            campaign::with_effect(setup, "servo.mismatch: tau_x_s=" + std::to_string(lag_s));
        const diagnosis::Diagnosis d =
            diagnosed(setup, campaign::measured(truth, servo_log(setup), 3));
        INFO(lag_s << " s: " << said(d));
        REQUIRE(!d.causes.empty());
        CHECK(d.causes.front().effect == "servo.mismatch");
        CHECK(value_of(d.causes.front(), "tau_x_s") == Approx(lag_s).epsilon(0.01));
        CHECK(d.explained > 0.99);
    }
}

TEST_CASE("a period is found at the ends of the search and none is made up beyond",
          "[diagnosis][bounds]") {
    const setup::Setup setup = campaign::bc_setup();
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_ballbar(table, setup, 240);
    const auto ripple = [&](double period_mm) {
        const setup::Setup truth = campaign::with_effect(
            campaign::real_machine(setup),
            fmt::format("X.cyclic: cos_mm=0.003, sin_mm=0.002, period_mm={}", period_mm));
        return diagnosed(setup, campaign::measured(truth, table, 4));
    };
    for (const double period_mm : {4.0, 4.1, 49.0, 50.0}) {
        const diagnosis::Diagnosis d = ripple(period_mm);
        INFO(period_mm << " mm: " << said(d));
        REQUIRE(!d.causes.empty());
        CHECK(d.causes.front().effect == "X.cyclic");
        CHECK(value_of(d.causes.front(), "period_mm") == Approx(period_mm).epsilon(0.01));
    }
    // Outside of what is searched: no period is named that is not there, and nothing is sure of it.
    for (const double period_mm : {3.0, 60.0}) {
        const diagnosis::Diagnosis d = ripple(period_mm);
        INFO(period_mm << " mm: " << said(d));
        for (const diagnosis::Cause& c : d.causes)
            if (c.effect == "X.cyclic" && c.probability > 0.5)
                CHECK(value_of(c, "period_mm") == Approx(period_mm).epsilon(0.01));
        CHECK(d.verdict != diagnosis::Verdict::no_gap);
    }
    const diagnosis::Diagnosis longer = ripple(240.0);  // less than one turn: a free form, a bow
    INFO("240 mm: " << said(longer));
    CHECK(!claims(longer, "X.cyclic"));
}

TEST_CASE("targets at whole degrees with gaps see no ripple of 356 periods in a turn for one of 4",
          "[diagnosis]") {
    std::vector<double> sparse{0.0};
    for (const double step_deg : {6.0, 5.0, 5.0, 4.0, 6.0, 5.0, 4.0, 5.0, 6.0, 6.0, 5.0, 4.0,
                                  5.0, 6.0, 4.0, 5.0, 5.0, 6.0, 4.0, 6.0, 5.0, 5.0, 4.0, 6.0})
        sparse.push_back(sparse.back() + rad_from_deg(step_deg));
    CHECK_FALSE(diagnosis::shows_period(sparse, 2.0 * pi / 356.0));
    CHECK_FALSE(diagnosis::shows_period(sparse, 2.0 * pi / 200.0));
    CHECK(diagnosis::shows_period(sparse, 2.0 * pi / 160.0));
    CHECK(diagnosis::shows_period(sparse, 2.0 * pi / 10.0));
    // At no common step, short periods are seen.
    for (std::size_t k = 0; k < sparse.size(); ++k)
        sparse[k] += rad_from_deg(0.3 * std::sin(1.7 * static_cast<double>(k * k)));
    CHECK(diagnosis::shows_period(sparse, 2.0 * pi / 356.0));
}

TEST_CASE("a period needs 8 places, two turns and no hole, of any kind of axis",
          "[diagnosis][bounds]") {
    const auto places = [](int count, double step) {
        std::vector<double> list;
        for (int k = 0; k < count; ++k) list.push_back(step * k);
        return list;
    };
    const double deg = rad_from_deg(1.0);
    for (const double unit : {1.0, deg}) {  // a linear axis in mm, a rotary one in degrees
        CHECK_FALSE(diagnosis::shows_period(places(7, 5.0 * unit), 12.0 * unit));
        CHECK(diagnosis::shows_period(places(8, 5.0 * unit), 12.0 * unit));
        CHECK(diagnosis::shows_period(places(8, 5.0 * unit), 17.0 * unit));
        CHECK_FALSE(diagnosis::shows_period(places(8, 5.0 * unit), 17.6 * unit));  // 1.99 turns
        CHECK_FALSE(diagnosis::shows_period(places(30, 5.0 * unit), 9.9 * unit));  // 1.98 spacings
        CHECK_FALSE(diagnosis::shows_period(places(30, 5.0 * unit), 5.0 * unit));  // one phase
        CHECK(diagnosis::shows_period(places(30, 5.0 * unit), 13.0 * unit));
        auto with_gaps = places(30, 5.0 * unit);  // a grid is one, some of its nodes empty or not
        with_gaps.erase(with_gaps.begin() + 7);
        with_gaps.erase(with_gaps.begin() + 20, with_gaps.begin() + 22);
        CHECK_FALSE(diagnosis::shows_period(with_gaps, 4.3 * unit));
        CHECK_FALSE(diagnosis::shows_period(with_gaps, 9.9 * unit));
        CHECK(diagnosis::shows_period(with_gaps, 13.0 * unit));
        // Phases 0, 0.2, 0.4 and 0.8: a hole of 0.4, no more.
        CHECK(diagnosis::shows_period({0, 1, 2, 4, 5, 6, 7, 9, 10}, 5.0));
        CHECK_FALSE(diagnosis::shows_period({0, 1, 2, 4.01, 5, 6, 7, 9.01, 10}, 5.0));
        with_gaps[3] += 1.7 * unit;  // one place beside it: no alias is exact any more
        CHECK(diagnosis::shows_period(with_gaps, 7.3 * unit));
    }
}

TEST_CASE("no lag of a second and scale of a percent stand for rows that were read at rest",
          "[diagnosis][bounds]") {
    const setup::Setup setup = campaign::bc_setup();
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_ballbar(table, setup, 120);
    std::erase_if(table.rows, [](const records::Reading& row) {  // circles, at one feed
        return row.test.find("_1000") == std::string::npos;
    });
    const std::size_t count = table.rows.size();
    for (std::size_t i = 0; i < count; ++i) {
        table.rows.push_back(table.rows[i]);
        table.rows.back().time_s += 3600.0;
        table.rows.back().test += " again";
    }
    const setup::Setup without = campaign::with_effect(
        campaign::real_machine(setup), "X.straightness: EYX_p2_mm=0.001, EZX_p2_mm=-0.001");
    const setup::Setup truth = campaign::with_effect(without, "Y.backlash: gap_mm=0.006");
    records::ReadingTable read = campaign::measured(truth, table, 3);
    const records::ReadingTable rest = campaign::measured(without, table, 3);
    for (std::size_t i = 0; i < read.rows.size(); ++i) {
        const bool ends = i == 0 || i + 1 == read.rows.size() ||
                          read.rows[i].test != read.rows[i - 1].test ||
                          read.rows[i].test != read.rows[i + 1].test;
        if (ends) read.rows[i].value_mm = rest.rows[i].value_mm;
    }
    const diagnosis::Diagnosis d = diagnosed(setup, read);
    INFO(said(d));
    REQUIRE(!d.causes.empty());
    CHECK(d.causes.front().effect == "Y.backlash");
    CHECK(d.causes.front().probability > 0.9);
    for (const diagnosis::Cause& cause : d.causes)
        for (const identification::FitParameter& p : cause.parameters) {
            if (p.unit == "ppm") CHECK(std::abs(p.value) < 1000.0);
            if (p.unit == "s^2") CHECK(std::abs(p.value) < 0.0101);
        }
}

TEST_CASE("a rotary axis that stood in few places gets no period, on a grid all that fit",
          "[diagnosis][bounds]") {
    const setup::Setup setup = campaign::bc_setup();
    const setup::Setup truth = campaign::with_effect(
        campaign::real_machine(setup), "B.cyclic: cos_rad=6e-5, sin_rad=4e-5, periods_per_turn=60");
    records::ReadingTable anywhere = campaign::empty_table(setup);
    campaign::add_sphere_map(anywhere, setup, 90, 3);
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
        const diagnosis::Diagnosis few =
            diagnosed(setup, campaign::measured(truth, map_in_places(setup, 6, seed), seed));
        INFO("6 places: " << said(few));
        CHECK(!claims(few, "B.cyclic"));
        CHECK(few.verdict != diagnosis::Verdict::no_gap);
        // 33 places every 5 degrees: 60 waves look like 12, and 12 are no more likely.
        const diagnosis::Diagnosis grid =
            diagnosed(setup, campaign::measured(truth, map_in_places(setup, 33, seed), seed));
        INFO("33 places: " << said(grid));
        REQUIRE(!grid.causes.empty());
        CHECK(grid.causes.front().effect == "B.cyclic");
        CHECK_THAT(grid.causes.front().what, Catch::Contains("the same: 60, 84"));
        CHECK_FALSE(grid.between_places);
        CHECK(grid.setup.effects.empty());
        const diagnosis::Diagnosis d = diagnosed(setup, campaign::measured(truth, anywhere, seed));
        INFO("anywhere: " << said(d));
        REQUIRE(!d.causes.empty());
        CHECK(d.causes.front().effect == "B.cyclic");
        CHECK(value_of(d.causes.front(), "periods_per_turn") == Approx(60.0));
    }
}

}  // namespace trunnion

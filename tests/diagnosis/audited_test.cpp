// What outside auditors acted on and found wrong, on sets of their own making.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <random>

#include "base/units.h"
#include "tests/support/campaign.h"
#include "tests/support/diagnosed.h"
#include "tests/support/said.h"

namespace trunnion {
namespace {

using Rows = std::function<bool(const records::Reading&)>;

/// Sphere maps of a table machine, and some passes of a ballbar.
records::ReadingTable map_beside(const setup::Setup& setup, const Rows& passes) {
    records::ReadingTable table = campaign::empty_table(setup), bar = table;
    campaign::add_sphere_map(table, setup, 60, 5);
    campaign::add_ballbar(bar, setup, 120);
    const double start_s = table.rows.back().time_s + 60.0;
    for (records::Reading& row : bar.rows) {
        row.time_s += start_s;
        if (passes(row)) table.rows.push_back(row);
    }
    return table;
}

records::ReadingTable fresh_map(const setup::Setup& truth, const setup::Setup& setup) {
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 100, 77);
    return campaign::measured(truth, table, 3, 0.0);
}

}  // namespace

TEST_CASE("what is explained is written, beside a pass of a bar that does not show it",
          "[diagnosis][audited]") {
    const setup::Setup setup = campaign::bc_setup();
    const setup::Setup truth = campaign::with_effect(
        campaign::real_machine(setup), "C.positioning: cos3_rad=1e-4, sin3_rad=-1.5e-4");
    const records::ReadingTable table = map_beside(setup, [](const records::Reading& row) {
        return row.test == "plane0_ccw_1000" || row.test == "plane0_cw_1000";
    });
    const diagnosis::Diagnosis d = diagnosed(setup, campaign::measured(truth, table, 1));
    INFO(said(d));
    CHECK(d.verdict == diagnosis::Verdict::explained);
    CHECK(d.writes_causes);
    CHECK(d.between_places);
    CHECK(left_beside(d.setup, fresh_map(truth, setup)) < 0.5e-3);  // of some 9e-3
}

TEST_CASE("spoiled readings of a probe are set aside beside many of a bar",
          "[diagnosis][audited]") {
    const setup::Setup setup = campaign::bc_setup();
    const setup::Setup truth = campaign::real_machine(setup);
    records::ReadingTable table = campaign::measured(
        truth, map_beside(setup, [](const records::Reading&) { return true; }), 1);
    const std::size_t spoiled = GENERATE(4, 9, 14);
    std::vector<std::size_t> probe;
    for (std::size_t i = 0; i < table.rows.size(); ++i)
        if (table.rows[i].device == records::Device::sphere) probe.push_back(i);
    for (std::size_t k = 0; k < spoiled; ++k)
        *table.rows[probe[7 + k * (probe.size() - 8) / spoiled]].value_mm += k % 2 ? 0.02 : -0.015;
    const diagnosis::Diagnosis d = diagnosed(setup, table);
    INFO(spoiled << ": " << said(d));
    CHECK(d.verdict == diagnosis::Verdict::no_gap);
    CHECK(d.outliers == spoiled);
    CHECK(left_beside(d.setup, fresh_map(truth, setup)) < 0.4e-3);
}

TEST_CASE("a bar that grows and shrinks within minutes is no noise", "[diagnosis][audited]") {
    const setup::Setup setup = campaign::bc_setup();
    const setup::Setup truth = campaign::real_machine(setup);
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_ballbar(table, setup, 120);
    campaign::add_ballbar(table, setup, 120);  // repeats tell the noise
    table = campaign::measured(truth, table, 1);
    const double size_mm = GENERATE(0.0, 0.002, 0.004);
    const double all_s = table.rows.back().time_s;
    for (records::Reading& row : table.rows)
        *row.value_mm += size_mm * std::sin(2.0 * pi * 7.3 * row.time_s / all_s);
    const diagnosis::Diagnosis d = diagnosed(setup, table);
    INFO(size_mm << " mm: " << said(d));
    CHECK((d.verdict == diagnosis::Verdict::no_gap) == (size_mm == 0.0));
}

TEST_CASE("an axis that turns with the square of its position is no squareness",
          "[diagnosis][audited]") {
    const setup::Setup setup = campaign::bc_setup();
    setup::Setup truth = campaign::with_effect(
        campaign::real_machine(setup),
        "X.angular: EAX_p2_rad=6e-5, EBX_p2_rad=-5e-5, ECX_p1_rad=3e-5, ECX_p2_rad=7e-5");
    const diagnosis::Diagnosis d = diagnosed(
        setup, campaign::measured(
                   truth, map_beside(setup, [](const records::Reading&) { return true; }), 2));
    INFO(said(d));
    REQUIRE(!d.causes.empty());
    CHECK(d.causes.front().effect == "X.angular");
    for (const char* other : {"XY.squareness", "YZ.squareness", "ZX.squareness", "B.zero"})
        CHECK(probability_of(d, other) < 0.5);
}

namespace {

setup::Setup plate_machine() {
    std::vector<std::string> notes;
    return setup::parse_setup(
        "[machine]\nname = \"p\"\nchain = \"w b X Y Z t\"\n"
        "[[artefact]]\nname = \"R1\"\nkind = \"target\"\ntool_mm = [0, 0, -100]\n"
        "[[instrument]]\nname = \"CMM\"\nfree = [\"pose\"]\n"
        "[model]\nmodelled = []\nnoise_um = { point = 1 }\n",
        "p.toml", notes);
}

}  // namespace

TEST_CASE("a plate that was measured row by row does not drift", "[diagnosis][audited]") {
    const unsigned seed = GENERATE(1u, 2u, 3u, 4u);
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> noise(0.0, 1e-3);
    const setup::Setup setup = plate_machine();
    records::ReadingTable table;
    table.path = "plate.csv";
    table.axes = {Axis::X, Axis::Y, Axis::Z};
    for (int k = 0; k < 49; ++k) {
        const double x = 50.0 * (k % 7), y = 50.0 * (k / 7);
        const double error_mm[] = {40e-6 * x + 40e-6 * y, 20e-6 * y};
        for (int d = 0; d < 2; ++d) {
            records::Reading row;
            row.index = k;
            row.time_s = 10.0 * k;
            row.test = "plate";
            row.device = records::Device::point;
            row.feature = "R1";
            row.commanded[Axis::X] = x;
            row.commanded[Axis::Y] = y;
            row.direction_M = Vector3::Unit(d);
            row.value_mm = error_mm[d] + noise(engine);
            table.rows.push_back(row);
        }
    }
    const diagnosis::Diagnosis d = diagnosed(setup, table);
    INFO(seed << ": " << said(d));
    CHECK(probability_of(d, "thermal.drift") < 0.75);
}

TEST_CASE("the steps of a display are no table of the axis", "[diagnosis][audited]") {
    const double step_mm = GENERATE(0.003, 0.005, 0.01);
    const unsigned seed = GENERATE(1u, 2u, 3u);
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> noise(0.0, 1e-3);
    std::vector<std::string> notes;
    const setup::Setup setup = setup::parse_setup(
        "[machine]\nname = \"m\"\nchain = \"w b X t\"\n"
        "[[artefact]]\nname = \"R1\"\nkind = \"target\"\ntool_mm = [0, 0, 0]\n"
        "[model]\nmodelled = []\n",
        "m.toml", notes);
    records::ReadingTable table;
    table.path = "x.csv";
    table.axes = {Axis::X};
    const auto add = [&](double at_mm, int side) {
        records::Reading row;
        row.index = static_cast<int>(table.rows.size());
        row.time_s = 20.0 * row.index;
        row.test = "x";
        row.commanded[Axis::X] = at_mm;
        if (side != 0) {
            row.device = records::Device::linear;
            row.feature = "R1";
            row.direction_M = Vector3::UnitX();
            const double value = 5.3 * step_mm * at_mm / 300.0 + 0.7 * side * step_mm;
            row.value_mm = step_mm * std::round((value + noise(engine)) / step_mm);
        }
        table.rows.push_back(row);
    };
    for (int cycle = 0; cycle < 3; ++cycle) {
        add(-2.0, 0);
        for (int k = 0; k <= 20; ++k) add(15.0 * k, 1);
        add(302.0, 0);
        for (int k = 20; k >= 0; --k) add(15.0 * k, -1);
    }
    const diagnosis::Diagnosis d = diagnosed(setup, table);
    INFO(step_mm << " mm, " << seed << ": " << said(d));
    CHECK(d.outliers == 0);
    CHECK(d.noise_um > 0.25 * 1e3 * step_mm);
    for (const diagnosis::Cause& c : d.causes)
        if (!c.points.empty()) CHECK(c.probability <= 0.4);
    CHECK(claims(d, "X.backlash"));
}

TEST_CASE("an order that may be the alias of a finer one is not written", "[diagnosis][audited]") {
    const int order = GENERATE(3, 7);
    std::mt19937_64 engine(5);
    std::normal_distribution<double> noise(0.0, 2e-6);
    std::vector<std::string> notes;
    const setup::Setup setup = setup::parse_setup(
        "[machine]\nname = \"t\"\nchain = \"w C b t\"\n"
        "[machine.axis.C]\ndirection = [0, 0, 1]\npoint_mm = [0, 0, 0]\n"
        "[[artefact]]\nname = \"R1\"\nkind = \"target\"\ntool_mm = [0, 0, 0]\n"
        "[model]\nmodelled = []\n",
        "t.toml", notes);
    records::ReadingTable table;
    table.path = "turn.csv";
    table.axes = {Axis::C};
    for (int k = 0; k < 48; ++k) {
        records::Reading row;
        row.index = k;
        row.time_s = 10.0 * k;
        row.test = "turn";
        row.device = records::Device::angle;
        row.feature = "R1";
        row.angular = true;
        row.direction_M = Vector3::UnitZ();
        row.commanded[Axis::C] = rad_from_deg(30.0 * k);
        row.value_mm = 60e-6 * std::sin(order * row.commanded[Axis::C] + 0.4) + noise(engine);
        table.rows.push_back(row);
    }
    const diagnosis::Diagnosis d = diagnosed(setup, table);
    INFO(order << ": " << said(d));
    REQUIRE(claims(d, "C.positioning"));
    CHECK(d.between_places == (order == 3));
    CHECK(d.writes_causes == (order == 3));
}

}  // namespace trunnion

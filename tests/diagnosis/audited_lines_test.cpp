// What outside auditors found on one axis, and over two sessions.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "base/units.h"
#include "tests/support/campaign.h"
#include "tests/support/diagnosed.h"
#include "tests/support/said.h"

namespace trunnion {
namespace {

setup::Setup stage() {
    std::vector<std::string> notes;
    return setup::parse_setup(
        "[machine]\nname = \"m\"\nchain = \"w b X t\"\n[machine.axis.X]\nencoder = \"scale\"\n"
        "[[artefact]]\nname = \"R1\"\nkind = \"target\"\ntool_mm = [0, 0, 0]\n"
        "[model]\nmodelled = []\nnoise_um = { linear = 0.5, axis = 1 }\n",
        "m.toml", notes);
}

/// A row of X; without a device it only tells the side.
records::Reading row_of(const records::ReadingTable& table, double at_mm) {
    records::Reading row;
    row.index = static_cast<int>(table.rows.size());
    row.test = "x";
    row.commanded[Axis::X] = at_mm;
    return row;
}

records::ReadingTable empty_line() {
    records::ReadingTable table;
    table.path = "x.csv";
    table.axes = {Axis::X};
    return table;
}

/// Period 40 mm, an overtone of half its height, and a play of 4 um.
double rippled_mm(double at_mm, int side) {
    const double turn = 2.0 * pi * at_mm / 40.0;
    return 3e-3 * std::sin(turn + 1.0) + 1.5e-3 * std::sin(2.0 * turn + 0.3) - 2e-3 * side;
}

/// There and back over these places.
records::ReadingTable line_over(const std::vector<double>& places_mm, int cycles, double noise_mm) {
    std::mt19937_64 engine(3);
    std::normal_distribution<double> noise(0.0, 1.0);
    records::ReadingTable table = empty_line();
    const auto add = [&](double at_mm, int side) {
        records::Reading row = row_of(table, at_mm);
        row.time_s = 20.0 * row.index;
        if (side != 0) {
            row.device = records::Device::linear;
            row.feature = "R1";
            row.direction_M = Vector3::UnitX();
            row.value_mm = rippled_mm(at_mm, side) + noise_mm * noise(engine);
        }
        table.rows.push_back(row);
    };
    for (int cycle = 0; cycle < cycles; ++cycle) {
        add(places_mm.front() - 2.0, 0);
        for (const double at_mm : places_mm) add(at_mm, 1);
        add(places_mm.back() + 2.0, 0);
        for (auto at = places_mm.rbegin(); at != places_mm.rend(); ++at) add(*at, -1);
    }
    return table;
}

}  // namespace

TEST_CASE("a ripple is written beside the table of its overtone", "[diagnosis][audited]") {
    std::mt19937_64 engine(4);
    std::uniform_real_distribution<double> off_mm(-1.0, 1.0);
    std::vector<double> places_mm, others_mm;
    for (int k = 0; k < 85; ++k) places_mm.push_back(3.54 * k + off_mm(engine));
    for (std::size_t k = 1; k < places_mm.size(); ++k)
        others_mm.push_back(0.5 * (places_mm[k - 1] + places_mm[k]));
    const diagnosis::Diagnosis d = diagnosed(stage(), line_over(places_mm, 3, 5e-4));
    INFO(said(d));
    CHECK(claims(d, "X.cyclic"));
    const records::ReadingTable between = line_over(others_mm, 1, 0.0);
    CHECK(left_beside(stage(), between) > 2.8e-3);
    CHECK(left_beside(d.setup, between) < 1.4e-3);  // of the overtone 1.06e-3
}

TEST_CASE("a play is claimed beside a delay, whether it adds to it or not",
          "[diagnosis][audited]") {
    const double gap_mm = GENERATE(-0.02, 0.02);
    std::mt19937_64 engine(5);
    std::normal_distribution<double> noise(0.0, 1e-3);
    constexpr double delay_s = 0.01;
    const auto way_mm = [](double t_s) {
        return 60.0 * std::sin(0.9 * t_s) + 25.0 * std::sin(2.3 * t_s + 0.4);
    };
    records::ReadingTable table = empty_line();
    for (int k = 1; k < 2500; ++k) {
        const double t_s = 0.01 * k, at_mm = way_mm(t_s);
        records::Reading row = row_of(table, at_mm);
        row.time_s = t_s;
        row.device = records::Device::axis;
        row.feature = "X";
        const int side = way_mm(t_s + 1e-6) > at_mm ? 1 : -1;
        row.value_mm = way_mm(t_s - delay_s) - at_mm + 0.5 * gap_mm * side + noise(engine);
        table.rows.push_back(row);
    }
    const diagnosis::Diagnosis d = diagnosed(stage(), table);
    INFO(gap_mm << " mm: " << said(d));
    CHECK(probability_of(d, "servo.mismatch") > 0.7);
    CHECK(probability_of(d, "X.backlash") > 0.7);
    for (const diagnosis::Cause& c : d.causes)
        if (c.effect == "X.backlash")
            CHECK(c.parameters.front().value == Approx(gap_mm).margin(1e-3));
}

TEST_CASE("tests of one name are zeroed anew in each session", "[diagnosis][audited]") {
    const setup::Setup setup = campaign::bc_setup();
    const setup::Setup truth = campaign::real_machine(setup);
    const unsigned seed = GENERATE(6u, 7u, 8u, 9u);
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> zero(0.0, 0.65e-3);
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 160, 5);
    table = campaign::measured(truth, table, 2);
    const std::size_t all = table.rows.size();
    std::vector<Vector3> zeros_mm(8);
    for (Vector3& z : zeros_mm) z = Vector3(zero(engine), zero(engine), zero(engine));
    for (std::size_t i = 0; i < all; ++i) {
        records::Reading& row = table.rows[i];
        const std::size_t part = 8 * i / all;
        row.test = "map" + std::to_string(part % 4);
        row.session = part < 4 ? "Monday" : "Tuesday";
        if (row.value_mm) *row.value_mm += row.direction_M.dot(zeros_mm[part]);
    }
    const diagnosis::Diagnosis d = diagnosed(setup, table);
    INFO(seed << ": " << said(d));
    CHECK(d.verdict == diagnosis::Verdict::no_gap);
}

}  // namespace trunnion

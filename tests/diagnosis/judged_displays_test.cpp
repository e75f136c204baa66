// What outside judges found where a display has few digits, or where passes are few.
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "base/units.h"
#include "tests/support/diagnosed.h"
#include "tests/support/said.h"

namespace trunnion {
namespace {

double rounded(double value, double digit) {
    return digit * std::round(value / digit);
}

/// One axis, and the noise only where it is given.
setup::Setup one_axis(const std::string& axis, const std::string& noise) {
    std::vector<std::string> notes;
    return setup::parse_setup(
        "[machine]\nname = \"m\"\nchain = \"w b " + axis + " t\"\n[machine.axis." + axis +
            (axis == "C" ? "]\ndirection = [0, 0, 1]\npoint_mm = [0, 0, 0]\n" : "]\n") +
            "[[artefact]]\nname = \"R1\"\nkind = \"target\"\n"
            "tool_mm = [0, 0, -100]\n[model]\nmodelled = []\n" +
            noise,
        "m.toml", notes);
}

records::ReadingTable table_of(Axis axis) {
    records::ReadingTable table;
    table.path = "m.csv";
    table.axes = {axis};
    return table;
}

records::Reading& add_row(records::ReadingTable& table, double at) {
    records::Reading row;
    row.index = static_cast<int>(table.rows.size());
    row.time_s = 12.0 * row.index;
    row.test = "t";
    row.commanded[table.axes.front()] = at;
    table.rows.push_back(row);
    return table.rows.back();
}

void read(records::Reading& row, double value, bool angular) {
    row.device = angular ? records::Device::angle : records::Device::linear;
    row.angular = angular;
    row.feature = "R1";
    row.direction_M = angular ? Vector3::UnitZ() : Vector3::UnitX();
    row.value_mm = value;
}

struct Line {
    int places, passes;
    double play_mm, noise_mm, digit_mm;
};

/// Passes there and back in turn, 20 mm between the targets.
records::ReadingTable line_of(const Line& line, unsigned seed) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> noise(0.0, line.noise_mm);
    records::ReadingTable table = table_of(Axis::X);
    for (int pass = 0; pass < line.passes; ++pass) {
        const int side = pass % 2 == 0 ? 1 : -1;
        add_row(table, side > 0 ? 18.0 : 20.0 * line.places + 2.0);
        for (int k = 0; k < line.places; ++k) {
            const int target = side > 0 ? k + 1 : line.places - k;
            const double value = 0.5 * side * line.play_mm + noise(engine);
            read(add_row(table, 20.0 * target), rounded(value, line.digit_mm), false);
        }
    }
    return table;
}

/// Angles kept to `digit_deg`, at 60 places of a turn; 72 periods of 40 urad.
records::ReadingTable worm(double digit_deg, unsigned seed, double noise_rad) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> noise(0.0, 1.0);
    std::uniform_real_distribution<double> angle_deg(0.0, 360.0);
    records::ReadingTable table = table_of(Axis::C);
    for (int k = 0; k < 60; ++k) {
        const double at = rad_from_deg(rounded(angle_deg(engine), digit_deg));
        read(add_row(table, at), 40e-6 * std::sin(72.0 * at + 0.4) + noise_rad * noise(engine),
             true);
    }
    return table;
}

}  // namespace

TEST_CASE("a ripple is written however many digits its angles have", "[diagnosis][judged]") {
    const double digit_deg = GENERATE(1e-2, 1e-3, 1e-4);
    const setup::Setup setup = one_axis("C", "noise_urad = { angle = 10 }\n");
    const diagnosis::Diagnosis d = diagnosed(setup, worm(digit_deg, 3, 10e-6));
    INFO(digit_deg << " deg: " << said(d));
    CHECK(d.verdict == diagnosis::Verdict::explained);
    CHECK(claims(d, "C.cyclic"));
    const records::ReadingTable elsewhere = worm(1e-4, 4, 0.0);
    CHECK(left_beside(setup, elsewhere) > 20e-6);
    CHECK(left_beside(d.setup, elsewhere) < 5e-6);
}

TEST_CASE("no reading is spoiled within the last digit of its display", "[diagnosis][judged]") {
    const unsigned seed = GENERATE(1u, 2u, 3u, 4u);
    const diagnosis::Diagnosis d =
        diagnosed(one_axis("X", ""), line_of({14, 10, 0.0, 0.3e-3, 1e-3}, seed));
    INFO(seed << ": " << said(d));
    CHECK(d.verdict == diagnosis::Verdict::no_gap);
    CHECK(d.outliers == 0);
}

TEST_CASE("a reading some digits off is set aside beside a coarse display", "[diagnosis][judged]") {
    records::ReadingTable table = line_of({14, 10, 0.0, 0.3e-3, 1e-3}, 5);
    *table.rows[40].value_mm += 5e-3;
    const diagnosis::Diagnosis d = diagnosed(one_axis("X", ""), table);
    INFO(said(d));
    CHECK(d.outliers == 1);
}

TEST_CASE("a play over two passes is no noise of a size that nobody states",
          "[diagnosis][judged]") {
    const unsigned seed = GENERATE(1u, 2u, 3u, 4u, 5u, 6u, 7u, 8u);
    const double play_mm = GENERATE(0.0, 4e-3);
    const diagnosis::Diagnosis d =
        diagnosed(one_axis("X", ""), line_of({8, 2, play_mm, 1e-3, 1e-4}, seed));
    INFO(seed << ", " << play_mm << " mm: " << said(d));
    CHECK((d.verdict == diagnosis::Verdict::no_gap) == (play_mm == 0.0));
}

}  // namespace trunnion

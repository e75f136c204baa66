// Records of others: no clock, large errors of an axis over part of a turn, a grid of points whose
// heights follow no smooth form, a part that moved during the test.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "base/units.h"
#include "tests/support/diagnosed.h"
#include "tests/support/said.h"

namespace trunnion {
namespace {

setup::Setup read_setup(const std::string& text) {
    std::vector<std::string> notes;
    return setup::parse_setup("[machine]\nname = \"m\"\n" + text, "s.toml", notes);
}

setup::Setup joint() {
    return read_setup(
        "chain = \"w b C t\"\n[machine.axis.C]\ndirection = [0, 0, 1]\npoint_mm = [0, 0, 0]\n"
        "[[artefact]]\nname = \"R1\"\nkind = \"target\"\ntool_mm = [100, 0, 0]\n"
        "[model]\nmodelled = []\nnoise_urad = { angle = 5 }\n");
}

setup::Setup bed() {
    return read_setup(
        "chain = \"w Y b X Z t\"\n[machine.axis.Y]\ndirection = [0, -1, 0]\n"
        "[[artefact]]\nname = \"R1\"\nkind = \"target\"\ntool_mm = [0, 0, -40]\n"
        "[[instrument]]\nname = \"I1\"\nframe = \"W\"\nfree = [\"pose\"]\n[model]\nmodelled = "
        "[]\n");
}

/// An encoder against a protractor, -60 to 60 degrees and back in steps of 1.5: a slope and a wave.
/// `odd`: only every second position, so that others are between them.
records::ReadingTable protractor(double slope, double wave_rad, bool odd) {
    records::ReadingTable table;
    table.path = "angles.csv";
    table.axes = {Axis::C};
    table.comment[records::times_key] = records::invented;
    std::mt19937_64 engine(odd ? 4 : 5);
    std::normal_distribution<double> noise(0.0, 5e-6);
    for (int k = 0; k < 160; ++k) {
        const int step = k < 80 ? k : 159 - k;
        records::Reading row;
        row.index = k;
        row.time_s = 60.0 * k;
        row.test = "C";
        row.device = records::Device::angle;
        row.angular = true;
        row.feature = "R1";
        row.direction_M = Vector3::UnitZ();
        const double q = rad_from_deg(1.5 * step - 60.0);
        row.commanded[Axis::C] = q;
        row.value_mm = slope * q + wave_rad * std::sin(7.0 * q) + noise(engine);
        if ((step % 2 == 0) != odd) table.rows.push_back(row);
    }
    return table;
}

/// Heights of a bed of 9 x 9 places with an error of its own at each place of X, and a twist.
records::ReadingTable heights(double twist, double noise_mm) {
    records::ReadingTable table;
    table.path = "bed.csv";
    table.axes = {Axis::X, Axis::Y, Axis::Z};
    table.comment[records::times_key] = records::invented;
    std::mt19937_64 engine(8);
    std::normal_distribution<double> noise(0.0, noise_mm), rough(0.0, 0.04);
    double along_x[9];
    for (double& e : along_x) e = rough(engine);
    for (int k = 0; k < 81; ++k) {
        records::Reading row;
        row.index = k;
        row.time_s = 60.0 * k;
        row.test = "bed";
        row.device = records::Device::point;
        row.feature = "R1";
        row.instrument = "I1";
        row.direction_M = Vector3::UnitZ();
        row.commanded[Axis::X] = 25.0 * (k % 9 - 4);
        row.commanded[Axis::Y] = 25.0 * (k / 9 - 4);
        row.value_mm = along_x[k % 9] + twist * row.commanded[Axis::X] * row.commanded[Axis::Y] +
                       noise(engine);
        table.rows.push_back(row);
    }
    table.optional_columns = {"instrument"};
    return table;
}

}  // namespace

TEST_CASE("a rotary axis over part of a turn: the written setup is right between the positions",
          "[diagnosis][foreign]") {
    for (const double size : {1.0, 100.0, 1000.0}) {  // 0.2 to 200 mrad
        const auto measured = protractor(1e-4 * size, 3e-5 * size, false);
        const auto later = protractor(1e-4 * size, 3e-5 * size, true);
        const diagnosis::Diagnosis d = diagnosed(joint(), measured);
        INFO(size << ": " << said(d));
        CHECK(claims(d, "C.positioning"));
        CHECK(left_beside(d.setup, measured) < 0.05 * left_beside(joint(), measured) + 6e-6);
        CHECK(left_beside(d.setup, later) < 0.1 * left_beside(joint(), later) + 8e-6);
        CHECK_FALSE(claims(d, "thermal.drift"));
    }
}

TEST_CASE("in one sweep without a clock nothing drifts", "[diagnosis][foreign]") {
    records::ReadingTable sweep = protractor(1e-4, 3e-5, false);
    sweep.rows.resize(sweep.rows.size() / 2);
    const diagnosis::Diagnosis d = diagnosed(joint(), sweep);
    INFO(said(d));
    CHECK(d.verdict != diagnosis::Verdict::no_gap);
    for (const diagnosis::DriverShare& where : d.where) CHECK(where.by != "time");
    CHECK_FALSE(claims(d, "thermal.drift"));
    // With the times of a clock, a drift cannot be told from the position.
    sweep.comment.clear();
    const diagnosis::Diagnosis timed = diagnosed(joint(), sweep);
    CHECK(std::any_of(timed.where.begin(), timed.where.end(),
                      [](const diagnosis::DriverShare& where) { return where.by == "time"; }));
}

TEST_CASE("heights of a grid that nothing tells between its places are written for these",
          "[diagnosis][foreign]") {
    const records::ReadingTable table = heights(4e-6, 0.008);
    const diagnosis::Diagnosis d = diagnosed(bed(), table);
    INFO(said(d));
    CHECK_FALSE(d.between_places);
    CHECK(d.writes_causes);
    CHECK(d.explained > 0.8);
    // A later part lies in a pose of its own, in its plane.
    const diagnosis::Diagnosis again = diagnosed(d.setup, table);
    INFO("again: " << said(again));
    CHECK(again.verdict == diagnosis::Verdict::no_gap);
    CHECK(again.rms_um < 12.0);
}

TEST_CASE("a step in time is not claimed as a drift", "[diagnosis][foreign]") {
    setup::Setup setup = read_setup(
        "chain = \"w b X Y Z t\"\n"
        "[[artefact]]\nname = \"R1\"\nkind = \"target\"\ntool_mm = [0, 0, -100]\n"
        "[model]\nmodelled = []\nnoise_um = { point = 5 }\n");
    records::ReadingTable table;
    table.path = "points.csv";
    table.axes = {Axis::X, Axis::Y, Axis::Z};
    std::mt19937_64 engine(9);
    std::normal_distribution<double> noise(0.0, 5e-3);
    std::uniform_real_distribution<double> at(-300.0, 300.0);
    for (int k = 0; k < 60; ++k) {
        AxisPositions place;
        for (const Axis axis : {Axis::X, Axis::Y, Axis::Z}) place[axis] = at(engine);
        for (int d = 0; d < 3; ++d) {
            records::Reading row;
            row.index = 3 * k + d;
            row.time_s = 60.0 * k;
            row.test = "points";
            row.device = records::Device::point;
            row.feature = "R1";
            row.commanded = place;
            row.direction_M = Vector3::Unit(d);
            row.value_mm = (k >= 22 ? Vector3(0.2, -0.3, 0.9)(d) : 0.0) + noise(engine);
            table.rows.push_back(row);
        }
    }
    const diagnosis::Diagnosis d = diagnosed(setup, table);
    INFO(said(d));
    CHECK(d.verdict != diagnosis::Verdict::no_gap);
    for (const diagnosis::Cause& cause : d.causes)
        if (cause.effect == "thermal.drift") {
            CHECK(cause.probability < 0.1);
            CHECK(std::count(cause.rivals.begin(), cause.rivals.end(), "machine.jump") == 1);
        }
    CHECK(claims(d, "thermal.drift"));  // it is listed, and doubted
}

}  // namespace trunnion

// What real measurements are like: a part at one height to one side of zero, a mount whose noise
// nobody states, an axis that stands upright.
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "base/units.h"
#include "diagnosis/diagnosis.h"
#include "effects/settings.h"
#include "emulator/replay.h"
#include "tests/support/said.h"

namespace trunnion {
namespace {

setup::Setup parsed(const std::string& text) {
    std::vector<std::string> notes;
    return setup::parse_setup(text, "s.toml", notes);
}

setup::Setup bench() {
    return parsed(
        "[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n"
        "[[artefact]]\nname = \"R1\"\nkind = \"target\"\ntool_mm = [0, 0, -150]\n"
        "[[instrument]]\nname = \"CMM\"\nframe = \"W\"\nfree = [\"pose\"]\n"
        "[model]\nmodelled = []\nnoise_um = { point = 1 }\n");
}

/// 10 x 10 points at one height, from the corner of the machine's travel on.
records::ReadingTable plate() {
    records::ReadingTable table;
    table.path = "plate.csv";
    table.axes = {Axis::X, Axis::Y, Axis::Z};
    for (int k = 0; k < 200; ++k) {
        records::Reading row;
        row.index = k;
        row.time_s = 60.0 * (k / 2);
        row.test = "plate";
        row.device = records::Device::point;
        row.feature = "R1";
        row.instrument = "CMM";
        row.direction_M = Vector3::Unit(k % 2);
        row.commanded[Axis::X] = 40.0 * (k / 2 % 10);
        row.commanded[Axis::Y] = 40.0 * (k / 20);
        row.commanded[Axis::Z] = -140.0;
        table.rows.push_back(row);
    }
    table.optional_columns = {"instrument"};
    return table;
}

void add_noise(records::ReadingTable& table, double sigma, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0.0, sigma);
    for (records::Reading& row : table.rows)
        if (row.value_mm) *row.value_mm += normal(random);
}

/// An upright axis C that carries an axis A: readings of both where `count` stars stand.
setup::Setup mount(const std::string& errors = "") {
    return parsed(
        "[machine]\nname = \"mount\"\nchain = \"w b C A t\"\n"
        "[machine.axis.C]\ndirection = [0, 0, -1]\npoint_mm = [0, 0, 0]\n"
        "[machine.axis.A]\ndirection = [1, 0, 0]\npoint_mm = [0, 0, 0]\n"
        "[[artefact]]\nname = \"T\"\nkind = \"target\"\ntool_mm = [0, 0, 100]\n"
        "[model]\nmodelled = []\n" +
        errors);
}

records::ReadingTable sky(int count) {
    records::ReadingTable table;
    table.path = "sky.csv";
    table.axes = {Axis::A, Axis::C};
    std::mt19937 random(7);
    std::uniform_real_distribution<double> even(0.0, 1.0);
    for (int k = 0; k < count; ++k) {
        const double azimuth = 2.0 * pi * even(random), tilt = 0.2 + 1.1 * even(random);
        for (int d = 0; d < 3; ++d) {
            records::Reading row;
            row.index = 3 * k + d;
            row.time_s = 30.0 * k;
            row.test = "sky";
            row.device = records::Device::angle;
            row.feature = "T";
            row.direction_M = Vector3::Unit(d);
            row.commanded[Axis::C] = azimuth;
            row.commanded[Axis::A] = tilt;
            table.rows.push_back(row);
        }
    }
    return table;
}

}  // namespace

// Seen through one arm, roll and pitch do the work of a squareness and a scale: those are the names
// (ISO 230-1). A bow about the machine's zero, at the edge of the plate, is mostly a slope.
TEST_CASE("a plate at one height, beside the zero of the axes: squareness and scale by their names",
          "[diagnosis]") {
    for (unsigned seed = 1; seed <= 3; ++seed) {
        setup::Setup real = bench();
        real.effects.push_back({"XY.squareness", {{"angle_rad", {40e-6}}}});
        real.effects.push_back({"X.scale", {{"scale_ppm", {-34.0}}}});
        real.effects.push_back({"Y.scale", {{"scale_ppm", {-25.0}}}});
        records::ReadingTable table =
            emulator::predicted(real, plate(), effects::active_models(real));
        add_noise(table, 1e-3, seed);
        const diagnosis::Diagnosis d = diagnosis::diagnose(bench(), table);
        INFO(seed << "\n" << said(d));
        for (const char* name : {"X.angular", "Y.angular", "X.straightness", "Y.straightness"})
            CHECK(probability_of(d, name) < 0.5);
        CHECK(probability_of(d, "XY.squareness") >= 0.5);
    }
}

TEST_CASE("noise that nobody states is told by neighbours, and a lean beside it is written",
          "[diagnosis]") {
    const setup::Setup real = mount("[machine.errors]\nEA0C_rad = 9e-4\n");
    records::ReadingTable table = emulator::predicted(real, sky(120), effects::active_models(real));
    add_noise(table, 400e-6, 1);
    const diagnosis::Diagnosis d = diagnosis::diagnose(mount(), table);
    INFO(said(d));
    CHECK(d.noise_um * 1e-3 == Approx(400e-6).margin(80e-6));  // the values are rad
    CHECK(probability_of(d, "location") >= 0.5);
    CHECK(d.writes_causes);
}

TEST_CASE("gravity does nothing to an upright axis", "[diagnosis]") {
    const setup::Setup upright = parsed(
        "[machine]\nname = \"table\"\nchain = \"w C b t\"\n"
        "[machine.axis.C]\ndirection = [0, 0, -1]\npoint_mm = [0, 0, 0]\n"
        "[[artefact]]\nname = \"T\"\nkind = \"target\"\ntool_mm = [0, 0, 100]\n"
        "[model]\nmodelled = []\nnoise_urad = { angle = 1 }\n");
    setup::Setup real = upright;
    real.effects.push_back({"C.positioning", {{"sin1_rad", {20e-6}}, {"sin2_rad", {15e-6}}}});
    records::ReadingTable table;
    table.path = "c.csv";
    table.axes = {Axis::C};
    for (int k = 0; k <= 72; ++k) {
        records::Reading row;
        row.index = k;
        row.time_s = 5.0 * k;
        row.test = "c";
        row.device = records::Device::angle;
        row.feature = "T";
        row.direction_M = Vector3(0, 0, -1);
        row.commanded[Axis::C] = rad_from_deg(5.0 * k);
        table.rows.push_back(row);
    }
    records::ReadingTable read = emulator::predicted(real, table, effects::active_models(real));
    add_noise(read, 1e-6, 3);
    const diagnosis::Diagnosis d = diagnosis::diagnose(upright, read);
    INFO(said(d));
    CHECK(probability_of(d, "gravity.sag") == 0.0);
    CHECK(probability_of(d, "C.positioning") >= 0.8);
    for (const diagnosis::Cause& c : d.causes)
        for (const std::string& rival : c.rivals) CHECK(rival != "gravity.sag");
}

// Exchanged with the resting Z, Y would rest and its whole lag be scatter at rest: another sigma is
// no better fit.
TEST_CASE("a servo log with an axis at rest has no exchanged columns", "[diagnosis]") {
    const setup::Setup mill =
        parsed("[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n[model]\nmodelled = []\n");
    setup::Setup real = mill;
    real.effects.push_back({"servo.mismatch", {{"tau_y_s", {8e-3}}}});
    records::ReadingTable table;
    table.path = "log.csv";
    table.axes = {Axis::X, Axis::Y, Axis::Z};
    for (int k = 0; k < 1500; ++k) {
        records::Reading row;
        row.index = k;
        row.time_s = 0.01 * k;
        row.test = "log";
        row.device = records::Device::axis;
        row.feature = "Y";
        const double t = row.time_s;  // moves, then rests
        row.commanded[Axis::Y] = t < 10.0 ? 20.0 * std::sin(1.1 * t) + 6.0 * std::sin(2.9 * t)
                                          : 20.0 * std::sin(11.0) + 6.0 * std::sin(29.0);
        table.rows.push_back(row);
    }
    records::ReadingTable read = emulator::predicted(real, table, effects::active_models(real));
    add_noise(read, 0.5e-3, 5);
    const diagnosis::Diagnosis d = diagnosis::diagnose(mill, read);
    INFO(said(d));
    CHECK(probability_of(d, "servo.mismatch") > 0.5);
    for (const std::string& note : d.notes) CHECK_THAT(note, !Catch::Contains("exchanged"));
}

}  // namespace trunnion

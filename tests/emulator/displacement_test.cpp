// Laser, autocollimator and servo log against closed forms.
#include <catch2/catch.hpp>

#include "base/units.h"
#include "effects/settings.h"
#include "emulator/replay.h"
#include "identification/identify.h"

using namespace trunnion;

namespace {

setup::Setup setup_with(const std::string& errors, const std::string& effects = "",
                        const std::string& axis = "") {
    std::vector<std::string> notes;
    return setup::parse_setup(
        "[machine]\nname = \"m\"\nchain = \"w C b X Y Z t\"\n[machine.axis.X]\ndirection = [1, 0, "
        "0]\n" +
            axis + "[machine.axis.C]\ndirection = [0, 0, -1]\npoint_mm = [0, 0, 0]\n" +
            "[machine.errors]\n" + errors + "[effects]\n" + effects +
            "[[artefact]]\nname = \"R1\"\nkind = \"target\"\ntool_mm = [0, 0, -150]\n"
            "[model]\nmodelled = []\nnoise_um = { linear = 0.1, axis = 0.1 }\n",
        "s.toml", notes);
}

records::Reading at(double x_mm, double time_s) {
    records::Reading row;
    row.test = "t";
    row.feature = "R1";
    row.time_s = time_s;
    row.commanded[Axis::X] = x_mm;
    return row;
}

/// The laser along X at these places, in this order.
records::ReadingTable laser(const std::vector<double>& places_mm) {
    records::ReadingTable table;
    table.axes = {Axis::X, Axis::Y, Axis::Z, Axis::C};
    for (const double x_mm : places_mm) {
        records::Reading row = at(x_mm, static_cast<double>(table.rows.size()));
        row.device = records::Device::linear;
        row.direction_M = Vector3::UnitX();
        row.value_mm = 0.0;
        table.rows.push_back(row);
    }
    return table;
}

records::ReadingTable predicted(const setup::Setup& setup, const records::ReadingTable& table) {
    return trunnion::emulator::predicted(setup, table, effects::active_models(setup));
}

}  // namespace

TEST_CASE("a laser counts scale and Abbe error from the first row of its test") {
    const setup::Setup machine =
        setup_with("EXX_mm = { slope = 2e-5 }\nEBX_rad = { slope = 1e-6 }\n");
    const records::ReadingTable read = predicted(machine, laser({-100.0, 0.0, 50.0}));
    CHECK(*read.rows[0].value_mm == 0.0);
    // 20 um a metre, and a pitch of 1 urad a mm with the target 150 mm below.
    for (const std::size_t k : {1U, 2U}) {
        const double way_mm = read.rows[k].commanded[Axis::X] + 100.0;
        CHECK(*read.rows[k].value_mm ==
              Approx(2e-5 * way_mm - 1e-6 * way_mm * 150.0).epsilon(1e-4));
    }
}

TEST_CASE("an autocollimator reads the tool against the table") {
    const setup::Setup machine = setup_with("ECC_rad = { harmonics = [[1, 0, 3e-5]] }\n");
    records::ReadingTable table = laser({0.0, 0.0});
    for (records::Reading& row : table.rows) {
        row.device = records::Device::angle;
        row.angular = true;
        row.direction_M = Vector3::UnitZ();
    }
    table.rows[1].commanded[Axis::C] = rad_from_deg(90.0);
    // The table turns by 30 urad more about +Z: the tool by as much less against it.
    CHECK(*predicted(machine, table).rows[1].value_mm == Approx(-3e-5).epsilon(1e-6));
}

TEST_CASE("an encoder at the motor sees the lag, one behind the drive the backlash too") {
    const std::string effects =
        "\"servo.mismatch\" = { tau_x_s = 1e-3 }\n\"X.backlash\" = { gap_mm = 0.01 }\n"
        "\"X.scale\" = { scale_ppm = 100 }\n";
    records::ReadingTable log = laser({0.0, 1.0, 2.0, 3.0, 2.0, 1.0});
    for (records::Reading& row : log.rows) {
        row.device = records::Device::axis;
        row.feature = "X";
    }
    log.rows[5].velocity_mm_s = -7.0;
    const records::ReadingTable motor = predicted(setup_with("", effects), log);
    const records::ReadingTable scale =
        predicted(setup_with("", effects, "encoder = \"scale\"\n"), log);
    CHECK(*motor.rows[1].value_mm == Approx(-1e-3));
    CHECK(*motor.rows[4].value_mm == Approx(1e-3));
    CHECK(*motor.rows[5].value_mm == Approx(7e-3));
    CHECK(*scale.rows[1].value_mm == Approx(4e-3));
    CHECK(*scale.rows[4].value_mm == Approx(-4e-3));
}

TEST_CASE("a log of two axes has the speeds of the moments around, not of the next row") {
    records::ReadingTable log = laser({0.0, 0.0, 1.0, 1.0, 2.0, 2.0});
    for (std::size_t k = 0; k < 6; ++k) {
        log.rows[k].device = records::Device::axis;
        log.rows[k].feature = k % 2 ? "Y" : "X";
        log.rows[k].time_s = static_cast<double>(k / 2);
    }
    const records::ReadingTable read =
        predicted(setup_with("", "\"servo.mismatch\" = { tau_x_s = 1e-3 }\n"), log);
    CHECK(*read.rows[2].value_mm == Approx(-1e-3));
    CHECK(*read.rows[3].value_mm == 0.0);
}

TEST_CASE("reversal and scale from a laser whose zero is free") {
    std::vector<double> places_mm;
    for (int run = 0; run < 2; ++run) {
        for (int k = -1; k <= 10; ++k) places_mm.push_back(50.0 * k);
        for (int k = 11; k >= 0; --k) places_mm.push_back(50.0 * k);
    }
    records::ReadingTable table = predicted(
        setup_with("", "\"X.backlash\" = { gap_mm = 0.0254 }\n\"X.scale\" = { scale_ppm = 30 }\n"),
        laser(places_mm));
    for (records::Reading& row : table.rows) *row.value_mm += 0.7;  // where the operator zeroed it
    const identification::Identification found =
        identification::identify(setup_with(""), table, {"X.backlash", "X.scale"});
    CHECK(found.rms_after_um < 1e-3);
    for (const identification::FitParameter& p : found.parameters) {
        INFO(p.effect << ' ' << p.name);
        if (p.effect == "X.backlash") CHECK(p.value == Approx(0.0254).epsilon(1e-4));
        if (p.name == "scale_ppm") CHECK(p.value == Approx(30.0).epsilon(1e-4));
        if (p.effect == "setup") CHECK(p.value == Approx(0.7).epsilon(1e-2));
    }
}

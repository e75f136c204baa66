// What diagnose says of files in the shapes of real exports (tests/imports/like_real, made by code
// that shares nothing with the product): the cause that was put in, and nothing false beside it.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "base/read_file.h"
#include "diagnosis/diagnosis.h"
#include "imports/import.h"
#include "tests/support/said.h"

namespace trunnion {
namespace {

using imports::ImportKind;

const std::string folder = TRUNNION_SOURCE_DIR "/tests/imports/like_real/";

struct Export {
    ImportKind kind;
    std::string file, setup;
    std::vector<std::string> told = {};
};

diagnosis::Diagnosis diagnosed(const Export& e) {
    std::vector<std::string> notes;
    const setup::Setup setup = setup::load_setup(folder + e.setup, notes);
    const std::vector<imports::ImportFile> files{{e.file, read_file(folder + e.file)}};
    const imports::Imported imported =
        imports::import_readings(e.kind, {setup, files, imports::Facts(e.told), {}});
    const records::ReadingTable table =
        records::parse_readings(imported.readings, "r.csv", notes, setup.machine.chain.names());
    diagnosis::DiagnosisOptions options;
    options.plan_next = false;
    return diagnosis::diagnose(setup, table, options);
}

/// The value of a parameter of a claimed effect in textbook form; NaN if it is not claimed.
double value_of(const diagnosis::Diagnosis& d, const std::string& effect, const std::string& name) {
    for (const diagnosis::Cause& c : d.causes)
        for (const identification::FitParameter& p : c.parameters)
            if (c.effect == effect && p.name == name) return p.value;
    return std::nan("");
}

/// Nothing but `allowed` is claimed with a probability of 0.9 or more.
void check_nothing_false(const diagnosis::Diagnosis& d, const std::set<std::string>& allowed) {
    for (const diagnosis::Cause& c : d.causes)
        if (c.probability >= 0.9) CHECK(allowed.contains(c.effect));
}

}  // namespace

TEST_CASE("a laser's line: the reversal first, the curve is called positioning",
          "[diagnosis][like_real]") {
    const diagnosis::Diagnosis d = diagnosed({ImportKind::iso230_2, "laser_x.csv", "bench.toml"});
    INFO(said(d));
    REQUIRE(!d.causes.empty());
    CHECK(d.causes.front().effect == "X.backlash");
    CHECK(value_of(d, "X.backlash", "gap_mm") == Approx(0.0254).epsilon(0.05));
    check_nothing_false(d, {"X.backlash", "X.scale", "X.positioning"});
    for (const diagnosis::Cause& c : d.causes)
        if (!c.points.empty()) CHECK(c.effect == "X.positioning");
}

TEST_CASE("a resolver's fourth order is named, although angle and time run alike",
          "[diagnosis][like_real]") {
    const diagnosis::Diagnosis d =
        diagnosed({ImportKind::pointing,
                   "resolver.dat",
                   "bench.toml",
                   {"columns=n, C reference [deg], C resolver [deg]", "step_s=1"}});
    INFO(said(d));
    REQUIRE(!d.causes.empty());
    CHECK(d.angles);
    CHECK(d.rms_um == Approx(58.0).epsilon(0.1));  // µrad: 70.9 and 38 over root 2, 11
    CHECK(d.explained > 0.9);
    CHECK(d.causes.front().effect == "C.positioning");
    CHECK(std::hypot(value_of(d, "C.positioning", "cos4_rad"),
                     value_of(d, "C.positioning", "sin4_rad")) == Approx(70.9e-6).epsilon(0.05));
    CHECK(value_of(d, "C.backlash", "gap_rad") == Approx(22e-6).epsilon(0.05));
    check_nothing_false(d, {"C.positioning", "C.backlash"});
}

TEST_CASE("a motor whose every second step falls short: a ripple of two steps, at these places",
          "[diagnosis][like_real]") {
    const diagnosis::Diagnosis d = diagnosed(
        {ImportKind::pointing, "full_steps.csv", "bench.toml", {"columns=n,C_cmd_deg,C_act_deg"}});
    INFO(said(d));
    REQUIRE(!d.causes.empty());
    CHECK(d.causes.front().effect == "C.cyclic");
    CHECK(value_of(d, "C.cyclic", "cos_rad") == Approx(813e-6).epsilon(0.02));
    CHECK_FALSE(d.between_places);
    CHECK(d.verdict == diagnosis::Verdict::explained);
    check_nothing_false(d, {"C.cyclic", "C.positioning"});
}

TEST_CASE("the lean of an azimuth axis that the setup does not model is a cause",
          "[diagnosis][like_real]") {
    const diagnosis::Diagnosis d = diagnosed({ImportKind::pointing, "telescope.csv", "mount.toml"});
    INFO(said(d));
    REQUIRE(!d.causes.empty());
    CHECK(d.causes.front().effect == "location");
    CHECK(d.verdict != diagnosis::Verdict::unexplained);
    CHECK(value_of(d, "location", "EA0Az_rad") == Approx(-60e-6).epsilon(0.05));
    CHECK(value_of(d, "location", "EB0Az_rad") == Approx(95e-6).epsilon(0.05));
    check_nothing_false(d, {"location"});
}

TEST_CASE("two joint zeros of an arm, not one effect of many parameters that imitates them",
          "[diagnosis][like_real]") {
    const diagnosis::Diagnosis d = diagnosed({ImportKind::points, "robot.csv", "arm.toml"});
    INFO(said(d));
    CHECK(value_of(d, "J2.zero", "offset_rad") == Approx(550e-6).epsilon(0.05));
    CHECK(value_of(d, "J3.zero", "offset_rad") == Approx(-900e-6).epsilon(0.05));
    check_nothing_false(d, {"J2.zero", "J3.zero"});
}

TEST_CASE("servo logs, plates and a circle: the effect that was put in", "[diagnosis][like_real]") {
    const diagnosis::Diagnosis mill =
        diagnosed({ImportKind::axis_log, "mill_log.csv", "bench.toml"});
    CHECK(value_of(mill, "servo.mismatch", "tau_z_s") == Approx(8.7e-3).epsilon(0.05));
    check_nothing_false(mill, {"servo.mismatch"});

    const diagnosis::Diagnosis lines =
        diagnosed({ImportKind::points, "plate_lines.csv", "bench.toml"});
    // The CMM reads too short, or both axes shrink alike: the same readings.
    const double gain_ppm = value_of(lines, "sensor.gain", "gain_ppm");
    const double stretch_ppm = value_of(lines, "machine.expansion", "stretch_ppm");
    CHECK((std::isnan(gain_ppm) ? stretch_ppm : gain_ppm) == Approx(-34.0).epsilon(0.05));
    CHECK(std::abs(value_of(lines, "XY.squareness", "angle_rad")) == Approx(41e-6).epsilon(0.05));
    check_nothing_false(lines, {"sensor.gain", "XY.squareness"});

    const diagnosis::Diagnosis bar = diagnosed({ImportKind::ballbar, "ballbar.txt", "bench.toml"});
    CHECK(std::abs(value_of(bar, "XY.squareness", "angle_rad")) == Approx(80e-6).epsilon(0.05));
    CHECK(value_of(bar, "Y.backlash", "gap_mm") == Approx(6e-3).epsilon(0.05));
    check_nothing_false(bar, {"XY.squareness", "Y.backlash"});
}

// Stars read the index of the azimuth times the cosine of the altitude, so that no zero of a test
// takes it: it is set-up nevertheless, whatever its size.
TEST_CASE("the index of the azimuth is set-up, and the lean of its axis the cause",
          "[diagnosis][like_real]") {
    std::vector<std::string> notes;
    const setup::Setup setup = setup::load_setup(folder + "mount.toml", notes);
    const std::vector<imports::ImportFile> files{
        {"telescope.csv", read_file(folder + "telescope.csv")}};
    const imports::Imported imported =
        imports::import_readings(ImportKind::pointing, {setup, files, imports::Facts({}), {}});
    records::ReadingTable table =
        records::parse_readings(imported.readings, "r.csv", notes, setup.machine.chain.names());
    constexpr double index_rad = 1.2e-3;
    const Axis altitude = *setup.machine.chain.names().find("Alt");
    for (records::Reading& row : table.rows)
        if (row.value_mm && row.test == "across_Alt")
            *row.value_mm += index_rad * std::cos(row.commanded[altitude]);
    diagnosis::DiagnosisOptions options;
    options.plan_next = false;
    const diagnosis::Diagnosis d = diagnosis::diagnose(setup, table, options);
    INFO(said(d));
    REQUIRE(!d.causes.empty());
    CHECK(d.causes.front().effect == "location");
    check_nothing_false(d, {"location", "chain.collimation"});
    const bool told = std::any_of(
        d.set_up_words.begin(), d.set_up_words.end(),
        [](const std::string& s) { return s.find("the index of Az is") != std::string::npos; });
    CHECK(told);
    // A turn about the azimuth, which is -Z here, moves the sight against the component that is
    // read.
    double found_rad = 0.0;
    for (const setup::EffectSetting& e : d.setup.effects)
        if (e.name == "Az.zero") found_rad = e.parameters.at("offset_rad").front();
    CHECK(found_rad == Approx(-index_rad).epsilon(0.1));
}

}  // namespace trunnion

#include "volumetric/volumetric.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "base/units.h"
#include "report/volumetric_report.h"

using namespace trunnion;

TEST_CASE("a volumetric map finds the place and the error that dominates") {
    std::vector<std::string> notes;
    setup::Setup setup =
        setup::load_setup(TRUNNION_SOURCE_DIR "/machines/mill_xy_table.toml", notes);
    setup.machine.errors.location(*kinematics::parse_error_name("EC0Y")) = 5e-5;
    setup.machine.errors.motion(*kinematics::parse_error_name("EXX")).slope = 1e-6;
    setup.machine.errors.motion(*kinematics::parse_error_name("EBZ")).constant = 1e-7;
    const volumetric::VolumetricMap map = volumetric::volumetric_map(setup, {}, {}, {});
    CHECK(map.points.size() == 5 * 5 * 5 * 5);  // X Y Z W
    REQUIRE(map.causes.size() == 3);
    CHECK(map.causes[0].name == "EC0Y");
    CHECK(map.causes[0].largest_mm == Approx(5e-5 * 500).epsilon(1e-6));
    CHECK(map.causes[1].name == "EXX");
    CHECK(map.causes[2].share < 1e-3);
    const volumetric::VolumetricPoint& worst = map.points[map.worst];
    CHECK(std::abs(worst.at[Axis::Y]) == 500);
    CHECK(map.causes[worst.worst].name == "EC0Y");
    double sum = 0.0;
    for (const volumetric::VolumetricCause& cause : map.causes) sum += cause.share;
    CHECK(sum == Approx(1.0));
}

TEST_CASE("a map that is stopped holds the poses that are done") {
    std::vector<std::string> notes;
    setup::Setup setup = setup::load_setup(TRUNNION_SOURCE_DIR "/machines/ac_trunnion.toml", notes);
    volumetric::VolumetricOptions options;
    options.go_on = [](std::size_t done, std::size_t total) {
        CHECK(total == 5 * 5 * 5 * 5 * 5);
        return done < 7;
    };
    const volumetric::VolumetricMap map = volumetric::volumetric_map(setup, {}, {}, options);
    CHECK(map.points.size() == 7);
    CHECK(map.rms_mm > 0.0);
}

TEST_CASE("contributions add up to the whole error of a five-axis machine") {
    std::vector<std::string> notes;
    const setup::Setup setup =
        setup::load_setup(TRUNNION_SOURCE_DIR "/machines/ac_trunnion.toml", notes);
    const volumetric::VolumetricMap map = volumetric::volumetric_map(setup, {}, {}, {3, 3, 150.0});
    CHECK(map.points.size() == 27 * 9);
    CHECK(map.causes.size() == 8);
    double squares = 0.0;
    for (const volumetric::VolumetricCause& cause : map.causes)
        squares += cause.rms_mm * cause.rms_mm;
    CHECK(map.rms_mm > 0.05);
    CHECK(map.rms_mm < 2.0 * std::sqrt(squares));
    CHECK(map.causes[0].name == "EY0C");  // 0.104 mm
}

TEST_CASE("one location error shows its length everywhere, and the rotaries go all the way") {
    std::vector<std::string> notes;
    setup::Setup setup = setup::load_setup(TRUNNION_SOURCE_DIR "/machines/bc_table.toml", notes);
    setup.machine.errors = {};
    setup.machine.errors.location(*kinematics::parse_error_name("EX0C")) = 0.02;
    const volumetric::VolumetricMap map = volumetric::volumetric_map(setup, {}, {}, {2, 6, 150.0});
    CHECK(map.points.size() == 8 * 6 * 6);
    double low_b = 1e9, high_b = -1e9, low_c = 1e9, high_c = -1e9;
    for (const volumetric::VolumetricPoint& p : map.points) {
        CHECK(p.error_W_mm.norm() == Approx(0.02).epsilon(1e-9));
        // The table has gone + X, so the tip is off to - X of the table as it stands.
        CHECK(p.error_W_mm.x() == Approx(-0.02 * std::cos(p.at[Axis::C])).margin(1e-12));
        low_b = std::min(low_b, p.at[Axis::B]), high_b = std::max(high_b, p.at[Axis::B]);
        low_c = std::min(low_c, p.at[Axis::C]), high_c = std::max(high_c, p.at[Axis::C]);
    }
    CHECK(rad_from_deg(110) == Approx(high_b));
    CHECK(rad_from_deg(-110) == Approx(low_b));
    CHECK(high_c - low_c == Approx(rad_from_deg(300)));  // six angles of one turn
    REQUIRE(map.causes.size() == 1);
    CHECK(map.causes[0].share == 1.0);
    CHECK(volumetric::volumetric_map(setup, {}, {}, {2, 1, 150.0}).points.size() == 8);
}

TEST_CASE("travel that was assumed and tables that end inside the travel are named") {
    std::vector<std::string> notes;
    const std::string head =
        "[machine]\nchain = \"w Y X b Z t\"\n[machine.axis.X]\nlimits_mm = "
        "[-300, 300]\n[machine.axis.Z]\nlimits_mm = [-100, 0]\n"
        "[machine.errors]\nEZZ_mm = { at_mm = [-100, 0], value = [0, 0.01] }\n";
    const setup::Setup setup = setup::parse_setup(
        head + "EXX_mm = { at_mm = [-300, 200], value = [0, 0.01] }\n", "m.toml", notes);
    const volumetric::VolumetricMap map = volumetric::volumetric_map(setup, {}, {}, {});
    CHECK(map.assumed == std::vector<Axis>{Axis::Y});
    CHECK(map.clamped == std::vector<Axis>{Axis::X});
    const std::string text = report::volumetric_text(map);
    CHECK_THAT(text, Catch::Contains("+-200 mm or +-180 degrees assumed: Y\n"));
    CHECK_THAT(text, Catch::Contains("held at its last value there: X\n"));
    for (const volumetric::VolumetricPoint& p : map.points) CHECK(std::abs(p.at[Axis::Y]) <= 200.0);
}

TEST_CASE("errors of the spindle and of the tool are causes too") {
    std::vector<std::string> notes;
    setup::Setup setup = setup::parse_setup(
        "[machine]\nchain = \"w Y X b Z t\"\n[machine.errors]\nEBS_rad = 2e-5\nEX0S_mm = 0.001\n",
        "m.toml", notes);
    const volumetric::VolumetricMap map = volumetric::volumetric_map(setup, {}, {}, {});
    REQUIRE(map.causes.size() == 2);
    CHECK(map.causes[0].name == "EBS");
    CHECK(map.causes[0].largest_mm == Approx(150 * 2e-5));
    CHECK(map.causes[1].name == "EX0S");
    CHECK(map.rms_mm == Approx(0.002));  // they pull against each other
}

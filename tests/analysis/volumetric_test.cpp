#include "analysis/volumetric.h"

#include <catch2/catch.hpp>

using namespace trunnion;

TEST_CASE("a volumetric map finds the place and the error that dominates") {
    std::vector<std::string> notes;
    Setup setup = load_setup(TRUNNION_SOURCE_DIR "/machines/mill_xy_table.toml", notes);
    setup.machine.errors.location(*parse_error_name("EC0Y")) = 5e-5;
    setup.machine.errors.motion(*parse_error_name("EXX")).slope = 1e-6;
    setup.machine.errors.motion(*parse_error_name("EBZ")).constant = 1e-7;
    const VolumetricMap map = volumetric_map(setup, {}, {}, {});
    CHECK(map.points.size() == 5 * 5 * 5 * 5);  // X Y Z W
    REQUIRE(map.causes.size() == 3);
    CHECK(map.causes[0].name == "EC0Y");
    CHECK(map.causes[0].largest_mm == Approx(5e-5 * 500).epsilon(1e-6));
    CHECK(map.causes[1].name == "EXX");
    CHECK(map.causes[2].share < 1e-3);
    const VolumetricPoint& worst = map.points[map.worst];
    CHECK(std::abs(worst.at[Axis::Y]) == 500);
    CHECK(map.causes[worst.worst].name == "EC0Y");
    double sum = 0.0;
    for (const VolumetricCause& cause : map.causes) sum += cause.share;
    CHECK(sum == Approx(1.0));
}

TEST_CASE("contributions add up to the whole error of a five-axis machine") {
    std::vector<std::string> notes;
    const Setup setup = load_setup(TRUNNION_SOURCE_DIR "/machines/ac_trunnion.toml", notes);
    const VolumetricMap map = volumetric_map(setup, {}, {}, {3, 150.0});
    CHECK(map.points.size() == 27 * 9);
    CHECK(map.causes.size() == 8);
    double squares = 0.0;
    for (const VolumetricCause& cause : map.causes) squares += cause.rms_mm * cause.rms_mm;
    CHECK(map.rms_mm > 0.05);
    CHECK(map.rms_mm < 2.0 * std::sqrt(squares));
    CHECK(map.causes[0].name == "EY0C");  // 0.104 mm
}

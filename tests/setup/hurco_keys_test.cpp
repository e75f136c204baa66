// [control.hurco]: switches, centrelines, what it refuses, and that it is written as it was read.
#include <catch2/catch.hpp>

#include "base/alarm.h"
#include "setup/setup.h"

namespace trunnion {

namespace {

setup::Setup parsed(const std::string& keys) {
    std::vector<std::string> notes;
    return setup::parse_setup(
        "[machine]\nname = \"t\"\nchain = \"w C A b Y X Z t\"\n"
        "axis.A = { direction = [-1, 0, 0], point_mm = [0, 0, 0] }\n"
        "axis.C = { direction = [0, 0, -1], point_mm = [0, 0, 0] }\n"
        "axis.X = { direction = [1, 0, 0] }\naxis.Y = { direction = [0, 1, 0] }\n"
        "axis.Z = { direction = [0, 0, 1] }\n"
        "[control]\ndialect = \"hurco\"\n[control.hurco]\n" +
            keys,
        "test.toml", notes);
}

/// Line of the message, 0 when there is none.
int refused(const std::string& keys) {
    try {
        parsed(keys);
    } catch (const InputError& error) {
        return error.where.line;
    }
    return 0;
}

}  // namespace

TEST_CASE("the centrelines of the part set-up are the believed pivot") {
    const setup::Setup s =
        parsed("centreline.A = { Y = 210, Z = -450 }\ncentreline.C = { X = 330, Y = 205 }\n");
    CHECK(s.stores.parameters.get(19700) == 0.0);
    CHECK(s.stores.parameters.get(19701) == 210.0);
    CHECK(s.stores.parameters.get(19702) == -450.0);
    CHECK(s.stores.parameters.get(19703) == 330.0);
    CHECK(s.stores.parameters.get(19704) == -5.0);
}

TEST_CASE("the keys of a Hurco are read and written") {
    const setup::Setup s = parsed(
        "nc = \"bnc\"\ntilt = \"positive\"\nplanes_stack = false\nclamps_alarm = true\n"
        "back_off_mm = 2.5\ntool_change_z_mm = -10\ncentreline.C = { X = 3, Y = 4 }\n");
    CHECK(s.hurco.bnc);
    CHECK(s.hurco.tilt == positioning::Branch::positive);
    CHECK_FALSE(s.hurco.planes_stack);
    CHECK(s.hurco.clamps_alarm);
    CHECK(s.hurco.tool_change_z_mm == -10.0);
    std::vector<std::string> notes;
    const setup::Setup again = setup::parse_setup(setup::format_setup(s), "again.toml", notes);
    CHECK(again.hurco == s.hurco);
    CHECK(again.centrelines == s.centrelines);
    CHECK(setup::format_setup(parsed("")).find("[control.hurco]") == std::string::npos);
}

TEST_CASE("wrong keys of a Hurco are refused where they stand") {
    CHECK(refused("nc = \"heidenhain\"\n") == 12);
    CHECK(refused("tilt = \"up\"\n") == 12);
    CHECK(refused("planes_stack = 1\n") == 12);
    CHECK(refused("back_off_mm = 0\n") > 0);
    CHECK(refused("centreline.X = { Y = 1, Z = 2 }\n") == 12);
    CHECK(refused("centreline.A = { Q = 1 }\n") == 12);
    CHECK_THROWS_AS(parsed("centreline.A = { X = 1, Z = 2 }\n"), InputError);
    CHECK_THROWS_AS(parsed("centreline.A = { Y = 1 }\n"), InputError);
}

}  // namespace trunnion

// Bad input of every kind of import: one message with file and line, and nothing written.
#include <filesystem>

#include "tests/cli/command_bench.h"
#include "tests/imports/import_bench.h"

using namespace trunnion;
using import_bench::refuses;
using imports::ImportKind;

namespace {

setup::Setup with_free_pose() {
    setup::Setup setup = import_bench::setup();
    setup.instruments.emplace_back();
    setup.instruments[0].name = "CMM";
    setup.instruments[0].free_pose = true;
    return setup;
}

}  // namespace

TEST_CASE("targets out of order are refused", "[imports][bad]") {
    refuses(import_bench::setup(),
            {ImportKind::iso230_2,
             "position [mm],run,direction,deviation [um]\n0,1,+,0\n200,1,+,2\n100,1,+,1\n",
             {"axis=X"},
             ""},
            "order", 4);
    for (const char* table : {"target [mm],1+ [um],1- [um]\n0,0,3\n200,1,5\n100,2,4\n",
                              "target [mm],1+ [um],1- [um]\n100,0,3\n0,1,5\n200,2,4\n"})
        refuses(import_bench::setup(), {ImportKind::iso230_2, table, {"axis=X"}, ""},
                "rise and fall", 4);
    refuses(
        import_bench::setup(),
        {ImportKind::iso230_2, "Position;0;200;100\nRun 1 up;0;1;2\n", {"axis=X", "unit=um"}, ""},
        "rise and fall", 2);
}

TEST_CASE("falling targets, and angles that pass zero, are in order", "[imports][bad]") {
    for (const auto& [axis, table] :
         {std::pair("axis=X", "target [mm],1+ [um],1- [um]\n200,0,3\n100,1,5\n0,2,4\n"),
          std::pair("axis=C", "target [deg],1+ [arcsec],1- [arcsec]\n270,0,3\n0,1,5\n90,2,4\n")})
        CHECK(import_bench::read_rows(import_bench::setup(),
                                      {ImportKind::iso230_2, table, {axis}, ""})
                  .size() == 6);
}

TEST_CASE("two units in one column are refused", "[imports][bad]") {
    refuses(import_bench::setup(),
            {ImportKind::axis_log, "time [s],X cmd [mm],X act [mm]\n0,1,1\n1,2,2001 um\n", {}, ""},
            "one unit", 3);
}

TEST_CASE("a clock that runs back within a session is refused, between sessions it is not",
          "[imports][bad]") {
    const std::string head =
        "time [s],x nominal,y nominal,z nominal,x measured,y measured,z measured,session\n";
    refuses(import_bench::setup(),
            {ImportKind::points, head + "5,1,2,3,1,2,3,a\n4,2,2,3,2,2,3,a\n", {}, ""},
            "not in ascending order", 3);
    CHECK(import_bench::rows(
              import_bench::setup(),
              {ImportKind::points, head + "5,1,2,3,1,2,3,a\n4,2,2,3,2,2,3,b\n", {}, ""})
              .rows.size() == 6);
}

TEST_CASE("an instrument whose pose is free wants three points in each session", "[imports][bad]") {
    const std::string head =
        "x nominal,y nominal,z nominal,x measured,y measured,z measured,session\n";
    const std::string a = "0,0,0,0,0,0,a\n10,0,0,10,0,0,a\n0,10,0,0,10,0,a\n";
    refuses(with_free_pose(),
            {ImportKind::points, head + a + "0,0,0,0,0,0,b\n5,0,0,5,0,0,b\n", {}, ""},
            "2 points of CMM in session b do not fix its pose", 5);
    CHECK(
        import_bench::rows(with_free_pose(), {ImportKind::points, head + a, {}, ""}).rows.size() ==
        9);
}

TEST_CASE("an axis or a device that nobody knows is refused", "[imports][bad]") {
    const setup::Setup setup = import_bench::setup();
    refuses(setup, {ImportKind::axis_log, "time [s],A cmd [deg],A act [deg]\n0,1,1\n", {}, ""},
            "no axis of the machine (X, Y, Z, B, C)", 1);
    refuses(setup, {ImportKind::iso230_2, "target [mm],1+ [um]\n0,0\n10,1\n", {"axis=Q"}, ""},
            "axis", 1);
    refuses(setup,
            {ImportKind::table,
             "p [mm],v [mm]\n1,2\n",
             {},
             "[columns]\nx_mm = \"p\"\n[[reading]]\ndevice = "
             "\"radar\"\nfeature = \"R1\"\nvalue_mm = \"v\"\n"},
            "device is sphere, touch", 2);
}

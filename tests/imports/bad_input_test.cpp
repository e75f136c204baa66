// Bad input of every kind of import: one message with file and line, and nothing written.
#include <cmath>
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

TEST_CASE("an ambiguous date above a table is refused, unless the session has a name",
          "[imports][bad]") {
    const auto dated = [](const std::string& day, std::vector<std::string> told) {
        told.emplace_back("axis=X");
        return import_bench::Case{ImportKind::iso230_2,
                                  "Date: " + day + "\ntarget [mm],1+ [um]\n0,0\n100,1\n",
                                  std::move(told), ""};
    };
    const setup::Setup setup = import_bench::setup();
    refuses(setup, dated("03/04/2026", {}), "two days", 1);
    refuses(setup, dated("spring", {}), "no date", 1);
    CHECK(import_bench::read_rows(setup, dated("13/04/2026", {}))[0].session == "2026-04-13");
    CHECK(import_bench::read_rows(setup, dated("--", {}))[0].session.empty());
    CHECK(import_bench::read_rows(setup, dated("03/04/2026", {"session=a"}))[0].session == "a");
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

TEST_CASE("points of a day count as a session of their own, those of two files of it together",
          "[imports][bad]") {
    const std::string head =
        "time,x nominal,y nominal,z nominal,x measured,y measured,z measured\n";
    const auto day = [](int of_month, int points) {
        std::string text;
        for (int k = 0; k < points; ++k)
            text += "2026-11-0" + std::to_string(of_month) + "T08:0" + std::to_string(k) + ":00," +
                    std::to_string(9 * k) + ",0,0," + std::to_string(9 * k) + ",0,0\n";
        return text;
    };
    const setup::Setup setup = with_free_pose();
    refuses(setup, {ImportKind::points, head + day(2, 4) + day(3, 2), {}, ""},
            "2 points of CMM in session 2026-11-03 do not fix its pose", 6);
    const std::vector<imports::ImportFile> files{{"a.csv", head + day(2, 2)},
                                                 {"b.csv", head + day(2, 2)}};
    const auto both = imports::import_readings(ImportKind::points,
                                               {setup, files, imports::Facts({"session=one"}), {}});
    CHECK_THAT(both.summary.back(), Catch::Contains("2 points"));
    refuses(setup,
            {ImportKind::points,
             head + "2026-11-02T08:00:00,0,0,0,0,0,0\n" + "2026-11-02T08:01:00,9,0,0,,,\n" +
                 "2026-11-02T08:02:00,9,9,0,9,9,0\n",
             {},
             ""},
            "2 points of CMM", 2);
}

TEST_CASE("the unit of a deviation is never guessed", "[imports][bad]") {
    const setup::Setup setup = import_bench::setup();
    for (const auto& [kind, text, name] :
         {std::tuple(ImportKind::points, "x nominal,y nominal,z nominal,dx,dy,dz\n1,2,3,4,5,6\n",
                     "'dx'"),
          std::tuple(ImportKind::points, "point,axis,nominal,deviation\nP1,X,1,2\nP1,Y,2,3\n",
                     "'deviation'"),
          std::tuple(ImportKind::axis_log, "time [s],X cmd [mm],X lag\n0,1,5\n1,2,5\n",
                     "'X lag'")}) {
        refuses(setup, {kind, text, {"sign=+"}, ""}, std::string("the unit of ") + name, 1);
        CHECK_FALSE(
            import_bench::read_rows(setup, {kind, text, {"sign=+", "unit=um"}, ""}).empty());
    }
    // Not needed beside both: the column is named as unused.
    const auto both = import_bench::imported(
        setup, {ImportKind::points,
                "x nominal,y nominal,z nominal,x measured,y measured,z measured,dx\n"
                "1,2,3,1,2,3,0.4\n",
                {},
                ""});
    REQUIRE(!both.notes.empty());
    CHECK_THAT(both.notes.back(), Catch::Contains("'dx' is not used"));
}

TEST_CASE("values that change as much as the targets are displacements, or refused",
          "[imports][bad]") {
    const setup::Setup setup = import_bench::setup();
    const auto table = [](double sign, double zero_mm) {
        std::string text = "Axis: X\nUnit: mm\ntarget [mm];1+;1-\n";
        for (int t = -350; t <= 350; t += 70)
            for (const char* part : {"", "+", "-"})
                text +=
                    *part == 0
                        ? std::to_string(t)
                        : ';' +
                              std::to_string(sign * t + zero_mm + (*part == '+' ? 0.006 : -0.006)) +
                              (*part == '-' ? "\n" : "");
        return import_bench::Case{ImportKind::iso230_2, text, {}, ""};
    };
    for (const double zero_mm : {0.0, 350.0}) {
        const auto rows = import_bench::read_rows(setup, table(1.0, zero_mm));
        REQUIRE(rows.size() == 22);
        CHECK(*rows[3].value_mm - *rows[18].value_mm == Approx(0.012));
        CHECK(std::abs(*rows[3].value_mm) < 0.02);
    }
    refuses(setup, table(-1.0, 0.0), "change as much as the targets", 3);
}

TEST_CASE("results below a table are no rows, a row that lost cells is refused", "[imports][bad]") {
    const std::string rows = "Axis: X\nUnit: um\ntarget [mm];1+;1-;2+;2-\n0;0;3;0;3\n100;1;5;1;5\n";
    const setup::Setup setup = import_bench::setup();
    CHECK(import_bench::read_rows(
              setup, {ImportKind::iso230_2, rows + "Mean;1;2;1;2\n\nB;-4;um\nA;6;um\n", {}, ""})
              .size() == 8);
    refuses(setup, {ImportKind::iso230_2, rows + "P;200;1;2\n300;1;2;1;2\n", {}, ""}, "row has 4",
            6);
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

// Points and angles of files that tell more: a printer's bed mesh, standard uncertainties, targets.
#include <algorithm>

#include "base/units.h"
#include "tests/imports/import_bench.h"

using namespace trunnion;
using import_bench::Case;
using import_bench::imported;
using import_bench::read_rows;
using import_bench::refuses;

namespace {

constexpr auto points = imports::ImportKind::points;
constexpr auto pointing = imports::ImportKind::pointing;

bool has(const std::vector<std::string>& list, const std::string& part) {
    return std::any_of(list.begin(), list.end(),
                       [&](auto& line) { return line.find(part) != std::string::npos; });
}

/// A mesh of 3 x 2 points, and settings without points before it.
std::string mesh(const std::string& mark, const std::string& equal) {
    const std::string lines[] = {
        "[bed_mesh default]",     "version" + equal + "1",     "points" + equal,
        "  0.010, 0.020, 0.030",  "  -0.040, 0.000, 0.050",    "x_count" + equal + "3",
        "y_count" + equal + "2",  "algo" + equal + "lagrange", "min_x" + equal + "10.0",
        "max_x" + equal + "50.0", "min_y" + equal + "5.0",     "max_y" + equal + "65.0"};
    std::string text = "[bed_mesh]\nspeed: 50\nmesh_min: 10, 5\n\n";
    for (const std::string& line : lines) text += mark + line + '\n';
    return text + mark + "\n" + mark + "[extruder]\n" + mark + "points = 7\n";
}

/// The same, as a table.
const std::string plain =
    "x nominal [mm],y nominal [mm],z nominal [mm],z measured [mm]\n"
    "10,5,0,0.010\n30,5,0,0.020\n50,5,0,0.030\n10,65,0,-0.040\n30,65,0,0.0\n50,65,0,0.050\n";

setup::Setup two_targets() {
    std::vector<std::string> notes;
    return setup::parse_setup(
        "[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n"
        "[[artefact]]\nname = \"R1\"\nkind = \"target\"\ntool_mm = [0, 0, -150]\n"
        "[[artefact]]\nname = \"R2\"\nkind = \"target\"\ntool_mm = [0, 0, -100]\n",
        "s.toml", notes);
}

}  // namespace

TEST_CASE("a printer's bed mesh is a table of heights", "[imports][more]") {
    const setup::Setup setup = import_bench::setup();
    const auto expected = read_rows(setup, {points, plain, {}, ""});
    for (const auto& [mark, equal] :
         {std::pair{"", ": "}, std::pair{"#*# ", " = "}, std::pair{"", " = "}}) {
        const Case c{points, mesh(mark, equal), {}, ""};
        INFO(c.text);
        const auto rows = read_rows(setup, c);
        REQUIRE(rows.size() == expected.size());
        for (std::size_t k = 0; k < rows.size(); ++k) {
            CHECK(*rows[k].value_mm == Approx(*expected[k].value_mm));
            CHECK(rows[k].commanded == expected[k].commanded);
        }
        CHECK(rows[0].source == "f.txt:8");
        CHECK(rows[5].source == "f.txt:9");
        CHECK(has(imported(setup, c).notes, "a bed mesh"));
    }
}

TEST_CASE("a bed mesh that lost a number is refused", "[imports][more]") {
    const setup::Setup setup = import_bench::setup();
    const auto changed = [](const std::string& from, const std::string& to) {
        std::string text = mesh("#*# ", " = ");
        return Case{points, text.replace(text.find(from), from.size(), to), {}, ""};
    };
    refuses(setup, changed("-0.040, ", ""), "2 points in this row, 3 in the first one", 9);
    refuses(setup, changed("-0.040, ", "x, "), "'x' is not a number", 9);
    refuses(setup, changed("x_count = 3", "x_count = 4"), "x_count is 4, but 3 are here", 8);
    refuses(setup, changed("min_x = 10.0", "min = 10"), "this mesh has no number min_x", 5);
}

TEST_CASE("coordinates one a line belong to the point of their name", "[imports][more]") {
    const setup::Setup setup = import_bench::setup();
    const std::string head = "name,axis,nominal,actual\n";
    const Case together{points,
                        head +
                            "P1,X,10,10.001\nP1,Y,20,20.002\nP1,Z,30,30.003\n"
                            "P2,X,40,40.004\nP2,Y,50,50.005\nP2,Z,60,60.006\n",
                        {"unit=mm"},
                        ""};
    const Case sorted{points,
                      head +
                          "P1,X,10,10.001\nP2,X,40,40.004\nP1,Y,20,20.002\n"
                          "P2,Y,50,50.005\nP1,Z,30,30.003\nP2,Z,60,60.006\n",
                      {"unit=mm"},
                      ""};
    const auto expected = read_rows(setup, together), found = read_rows(setup, sorted);
    REQUIRE(found.size() == 6);
    for (std::size_t k = 0; k < 6; ++k) {
        CHECK(*found[k].value_mm == Approx(*expected[k].value_mm));
        CHECK(found[k].commanded == expected[k].commanded);
    }
    // Without names nobody tells which lines are one point.
    refuses(setup,
            {points,
             "axis,nominal,actual\nX,10,10.001\nX,40,40.004\nY,20,20.002\nY,50,50.005\n",
             {"unit=mm"},
             ""},
            "which are one point?", 3);
    CHECK(read_rows(setup, {points,
                            "axis,nominal,actual\nX,10,10.001\nY,20,20.002\nX,40,40.004\n"
                            "Y,50,50.005\n",
                            {"unit=mm"},
                            ""})
              .size() == 4);
}

TEST_CASE("uncertainties of rows", "[imports][more]") {
    const setup::Setup setup = import_bench::setup();
    for (const char* name : {"sigma", "sd", "std", "uncertainty"}) {
        INFO(name);
        const auto rows =
            read_rows(setup, {pointing,
                              "C cmd [deg],C act [deg]," + std::string(name) +
                                  " [arcsec]\n0,0.001,3.6\n10,10.002,7.2\n20,20.001,\n",
                              {},
                              ""});
        REQUIRE(rows.size() == 3);
        CHECK(rows[1].sigma_mm.value_or(0.0) == Approx(rad_from_deg(0.002)));
        CHECK_FALSE(rows[2].sigma_mm.has_value());
        const auto heights =
            read_rows(setup, {points,
                              "x nominal [mm],y nominal [mm],z nominal [mm],z measured [mm]," +
                                  std::string(name) + " [um]\n10,5,0,0.010,2\n30,5,0,0.020,3\n",
                              {},
                              ""});
        CHECK(heights[1].sigma_mm.value_or(0.0) == Approx(0.003));
    }
    CHECK_FALSE(
        has(imported(setup, {pointing, "C cmd [deg],C act [deg],sd\n0,0.1,0.2\n1,1,0.1\n", {}, ""})
                .notes,
            "not used"));
}

TEST_CASE("points of several targets", "[imports][more]") {
    const std::string text =
        "feature,x nominal [mm],y nominal [mm],z nominal [mm],z measured [mm]\n"
        "R1,10,5,0,0.010\nR2,10,5,0,0.020\nR1,30,5,0,0.030\n";
    const auto rows = read_rows(two_targets(), {points, text, {}, ""});
    REQUIRE(rows.size() == 3);
    CHECK(rows[1].feature == "R2");
    CHECK(rows[2].feature == "R1");
    CHECK(rows[0].commanded[Axis::Z] == Approx(150.0));
    CHECK(rows[1].commanded[Axis::Z] == Approx(100.0));
    refuses(two_targets(), {points, plain, {}, ""}, "several artefacts", 0);
}

TEST_CASE("two plates of one day: one pose, or one of each", "[imports][more]") {
    const setup::Setup setup = import_bench::setup();
    const std::vector<imports::ImportFile> files{{"plates/first.csv", plain},
                                                 {"plates/second.csv", plain}};
    for (const bool each : {false, true}) {
        std::vector<std::string> told;
        if (each) told.emplace_back("session=each");
        const imports::Imported got =
            imports::import_readings(points, {setup, files, imports::Facts(told), {}});
        CHECK(has(got.notes, "2 files are one set-up") == !each);
        std::vector<std::string> notes;
        const auto table =
            records::parse_readings(got.readings, "r.csv", notes, setup.machine.chain.names());
        REQUIRE(!table.rows.empty());
        CHECK(table.rows.front().session == (each ? "first" : ""));
        CHECK(table.rows.back().session == (each ? "second" : ""));
    }
}

TEST_CASE("a TPOINT run in azimuth and altitude", "[imports][more]") {
    std::vector<std::string> notes;
    const setup::Setup mount =
        setup::load_setup(TRUNNION_SOURCE_DIR "/tests/imports/like_real/mount.toml", notes);
    const std::string head =
        "! made by hand\nA night of 2024\n: ALTAZ\n: NODA\n+50 54 0.0 2024 2 17 5.0 960 300 0.6\n";
    const std::string rows = "10.5 30.25 10.4 30.2\n! a cloud\n200.5 60.5 -159.4 60.4 1.2\n";
    const Case run{pointing, head + rows + "END\n1 2 3 4\n", {}, ""};
    const auto got = imported(mount, run);
    CHECK(has(got.notes, "a TPOINT run"));
    const auto stars = [&](const Case& c) {
        return records::parse_readings(imported(mount, c).readings, "r.csv", notes,
                                       mount.machine.chain.names())
            .rows;
    };
    const auto read = stars(run);
    const Case table{pointing,
                     "Az cmd [deg],Alt cmd [deg],Az act [deg],Alt act [deg]\n"
                     "10.4,30.2,10.5,30.25\n-159.4,60.4,200.5,60.5\n",
                     {},
                     ""};
    const auto expected = stars(table);
    REQUIRE(read.size() == expected.size());
    REQUIRE(read.size() == 4);
    for (std::size_t k = 0; k < read.size(); ++k) {
        CHECK(*read[k].value_mm == Approx(*expected[k].value_mm));
        CHECK(read[k].commanded == expected[k].commanded);
    }
    CHECK(read.back().source == "f.txt:8");
    // The latitude alone, and words behind a star.
    CHECK(stars({pointing, "run\n: ALTAZ\n-30 14 40.3\n" + rows + "END\n", {}, ""}).size() == 4);
    CHECK(stars({pointing, "run\n: ALTAZ\n10 30 10 30 0.4 ; [26] A_26\n" + rows, {}, ""}).size() ==
          6);
    // Without the line about the site the first star is one.
    CHECK(stars({pointing, "run\n: ALTAZ\n" + rows + "END\n", {}, ""}).size() == 4);
    refuses(mount, {pointing, head + "10.5 30.25 10.4\nEND\n", {}, ""}, "four angles", 6);
    refuses(mount, {pointing, "run\n: EQUAT\n+50 54 0 2024 2 17\nEND\n", {}, ""}, "equatorial", 2);
    refuses(import_bench::setup(), run, "two rotary axes that carry", 1);
}

TEST_CASE("files of one name in two folders are two sessions", "[imports][more]") {
    const setup::Setup setup = import_bench::setup();
    const std::vector<imports::ImportFile> files{{"monday/plate.csv", plain},
                                                 {"friday/plate.csv", plain}};
    const imports::Imported got =
        imports::import_readings(points, {setup, files, imports::Facts({"session=each"}), {}});
    std::vector<std::string> notes;
    const auto table =
        records::parse_readings(got.readings, "r.csv", notes, setup.machine.chain.names());
    CHECK(table.rows.front().session == "plate");
    CHECK(table.rows.back().session == "plate_2");
}

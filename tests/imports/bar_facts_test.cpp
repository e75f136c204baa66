// Facts of a ballbar's file: radius, feed and their units; columns beside the readings.
#include <algorithm>
#include <cmath>

#include "base/numbers.h"
#include "base/units.h"
#include "tests/cli/command_bench.h"
#include "tests/imports/import_bench.h"

using namespace trunnion;
using import_bench::Case;
using import_bench::imported;
using import_bench::read_rows;
using import_bench::refuses;

namespace {

const std::string rows = "angle [deg];deviation [um]\n0;0,5\n90;1\n180;0\n270;-1\n";

Case bar(const std::string& head, const std::string& table = rows) {
    return {imports::ImportKind::ballbar, "Plane: XY\nDirection: CCW\n" + head + table, {}, ""};
}

bool has(const std::vector<std::string>& list, const std::string& part) {
    return std::any_of(list.begin(), list.end(),
                       [&](auto& line) { return line.find(part) != std::string::npos; });
}

setup::Setup with_bar(double length_mm) {
    setup::Setup setup = import_bench::setup();
    setup.ballbar->length_mm = length_mm;
    return setup;
}

}  // namespace

TEST_CASE("the radius of a file must be the bar's", "[imports][bar]") {
    for (const char* line : {"Radius: 150 mm", "Length: 150", "Radius [mm];150", "Nennradius: 150",
                             "Durchmesser: 300 mm", "Bar length: 15 cm"}) {
        INFO(line);
        const std::string head = std::string(line) + '\n';
        refuses(import_bench::setup(), bar(head), "radius is 150 mm, and [ballbar] length_mm", 3);
        CHECK(read_rows(with_bar(150), bar(head)).size() == 4);
    }
    CHECK(has(imported(import_bench::setup(), bar("Radius: 100,003 mm\n")).notes,
              "radius 100.003 mm; read with the bar's 100 mm"));
    for (const char* line : {"Cable length: 3 m\n", "Ball diameter: 12 mm\n"})
        CHECK(read_rows(import_bench::setup(), bar(line)).size() == 4);
}

TEST_CASE("lengths of another bar, and lengths as deviations, are refused", "[imports][bar]") {
    const std::string lengths = "[mm]\n0;150,0005\n90;150,001\n180;150\n270;149,999\n";
    refuses(import_bench::setup(), bar("", "angle [deg];radius " + lengths),
            "the lengths are about 150 mm", 3);
    refuses(import_bench::setup(), bar("", "angle [deg];deviation " + lengths), "lengths", 3);
    CHECK(read_rows(with_bar(150), bar("", "angle [deg];radius " + lengths)).size() == 4);
}

TEST_CASE("a circle of the bar's radius gives its squareness", "[imports][bar]") {
    // Squareness of s rad: the bar reads - s R sin a cos a.
    constexpr double s = -80e-6, radius_mm = 150.0;
    std::string table = "angle [deg];deviation [um]\n";
    for (int a = 0; a < 360; a += 10) {
        const double angle = rad_from_deg(a);
        table += std::to_string(a) + ';' +
                 shortest(-1e3 * s * radius_mm * std::sin(angle) * std::cos(angle)) + '\n';
    }
    const CommandBench bench;
    const std::string bar_csv = bench.write("bar.csv", bar("Radius: 150 mm\n", table).text);
    const auto import = [&](const std::string& length_mm) {
        std::string text = R"(
[machine]
name  = "m"
chain = "w b X Y Z t"
[ballbar]
cup_mm    = [0, 0, -120]
length_mm = LENGTH
free      = ["cup", "length"]
[[artefact]]
name      = "P1"
kind      = "center_pivot"
center_mm = [75, 10, 110]
)";
        text.replace(text.find("LENGTH"), 6, length_mm);
        const std::string setup = bench.write("s.toml", text);
        return bench.trunnion("import ballbar " + bar_csv + " --setup " + setup + " --out " +
                              bench.file("r.csv"));
    };
    CHECK(import("100") == 2);
    CHECK_FALSE(std::filesystem::exists(bench.path / "r.csv"));
    REQUIRE(import("150") == 0);
    REQUIRE(bench.trunnion("identify " + bench.file("r.csv") + " --setup " + bench.file("s.toml") +
                           " --effects XY.squareness") == 0);
    CHECK_THAT(bench.read("out.txt"), Catch::Matches("[^]*XY\\.squareness +angle +-80\\.0+ [^]*"));
}

TEST_CASE("the feed has its unit", "[imports][bar]") {
    for (const auto& [line, feed] :
         std::vector<std::pair<std::string, double>>{{"Feed: 40 in/min", 1016},
                                                     {"Feed: 40 ipm", 1016},
                                                     {"Feed [in/min]: 40", 1016},
                                                     {"Feed;40;in/min", 1016},
                                                     {"Feed: 1 m/min", 1000},
                                                     {"Vorschub: 1,5 m/min", 1500},
                                                     {"Feedrate: 20 mm/s", 1200},
                                                     {"Feed: 1000", 1000},
                                                     {"Feed: 1000 [mm/min]", 1000}}) {
        INFO(line);
        CHECK(read_rows(import_bench::setup(), bar(line + '\n')).front().feed_mm_min == feed);
    }
    for (const char* line : {"Feed: 1000 foo", "Feed: 1.000", "Feed: 40 deg/min", "Feed: fast"})
        refuses(import_bench::setup(), bar(std::string(line) + '\n'), "feed", 3);
    Case told = bar("");
    told.told = {"feed=1 m/min"};
    CHECK(read_rows(import_bench::setup(), told).front().feed_mm_min == 1000.0);
}

TEST_CASE("a second circle beside the first is not lost", "[imports][bar]") {
    for (const char* other : {"deviation 2 [um]", "run 2 [um]", "CW [um]"})
        refuses(import_bench::setup(),
                bar("", "angle [deg];deviation [um];" + std::string(other) + "\n0;1;2\n90;2;3\n"),
                "not understood", 3);
    const auto result =
        imported(import_bench::setup(),
                 bar("", "angle [deg];deviation [um];Temp;X [mm]\n0;1;2;3\n90;2;3;4\n"));
    CHECK(has(result.notes, "not read: 'Temp', 'X'"));
}

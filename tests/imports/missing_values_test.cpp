// Missing values of points, of mapped tables and of logs: left out and told, never taken as 0.
#include <algorithm>

#include "tests/imports/import_bench.h"

using namespace trunnion;
using import_bench::Case;
using import_bench::imported;
using import_bench::read_rows;
using import_bench::refuses;

namespace {

using imports::ImportKind;

bool has(const std::vector<std::string>& list, const std::string& part) {
    return std::any_of(list.begin(), list.end(),
                       [&](auto& line) { return line.find(part) != std::string::npos; });
}

const std::string map = R"([columns]
x_mm = { column = "X", unit = "mm" }
temperature_c = "temp"
[[reading]]
device = "linear"
feature = "R1"
dir_x = 1
value_mm = { column = "dX", unit = "um" }
)";

}  // namespace

TEST_CASE("a mapped table without a value gives no reading, but the move", "[imports][missing]") {
    for (const char* hole : {"", "-", "n.a.", "NaN"}) {
        INFO(hole);
        const Case c{ImportKind::table,
                     "X;dX;temp\n0;1;20\n100;" + std::string(hole) + ";20\n200;3;\n" + hole +
                         ";4;20\n300;5;20\n",
                     {},
                     map};
        const setup::Setup setup = import_bench::setup();
        const auto rows = import_bench::rows(setup, c).rows;
        REQUIRE(rows.size() == 4);
        CHECK(rows[1].device == records::Device::none);
        CHECK(rows[1].commanded[Axis::X] == 100.0);
        CHECK(rows[2].value_mm.value() == 0.003);
        CHECK(rows[3].commanded[Axis::X] == 300.0);
        const auto result = imported(setup, c);
        CHECK(has(result.summary, "5 lines, 3 readings"));
        CHECK(has(result.notes, "2 readings without a value are left out: line 3 'dX', line 5"));
        CHECK(result.readings.starts_with("# times = invented\n"));
    }
}

TEST_CASE("a point without its nominal coordinate is left out", "[imports][missing]") {
    const setup::Setup setup = import_bench::setup();
    const Case columns{ImportKind::points,
                       "x nominal;y nominal;z nominal;x measured;y measured;z measured\n"
                       "0;0;-140;0,001;0;-140\n;0;-140;50;0;-140\n",
                       {},
                       ""};
    CHECK(read_rows(setup, columns).size() == 3);
    CHECK(has(imported(setup, columns).notes, "left out: line 3 'nominal'"));
    const Case lines{
        ImportKind::points,
        "name;axis;nominal;actual\nA;X;0;0,001\nA;Y;0;0\nB;X;;50\nB;Y;0;0\nB;D;10;10\n",
        {},
        ""};
    CHECK(read_rows(setup, lines).size() == 2);
    CHECK(has(imported(setup, lines).notes, "1 line of no coordinate not read: 'D'"));
    refuses(setup, {ImportKind::points, "B;C;X;Y;Z;dX;dY;dZ\n0;0;120;0;230;1;2;3\n", {}, ""},
            "unit of 'dX'", 1);
}

TEST_CASE("a logged row without a position is left out", "[imports][missing]") {
    const Case c{
        ImportKind::axis_log, "N,time [s],X,Y,Z\n10,0,0,0,\n20,1,1,n.a.,\n30,2,2,2,\n", {}, ""};
    const auto result = imported(import_bench::setup(), c);
    std::vector<std::string> of_block;  // a column that readings do not have
    const auto rows = records::parse_readings(result.readings, "r.csv", of_block).rows;
    REQUIRE(rows.size() == 2);
    CHECK(rows[1].commanded[Axis::Y] == 2.0);
    const auto& notes = result.notes;
    CHECK(has(notes, "Y: 1 rows without a value are left out"));
    CHECK(has(notes, "column 'Z' is not used"));
}

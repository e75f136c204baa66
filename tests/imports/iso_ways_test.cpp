// Directions of ISO 230-2 tables: two tables of one test, directions told above a table, passes in
// one direction only; units and times that no column tells.
#include <algorithm>
#include <set>

#include "records/iso230_2.h"
#include "tests/imports/import_bench.h"

using namespace trunnion;
using import_bench::Case;
using import_bench::imported;
using import_bench::read_rows;
using import_bench::refuses;

namespace {

constexpr auto iso = imports::ImportKind::iso230_2;

const std::string up = "0,0,0.4\n100,1,1.4\n200,2,2.4\n", down = "0,3,3.4\n100,5,5.4\n200,4,4.4\n";
const std::string one_table =
    "target [mm],1+ [um],1- [um],2+ [um],2- "
    "[um]\n0,0,3,0.4,3.4\n100,1,5,1.4,5.4\n200,2,4,2.4,4.4\n";

bool has(const std::vector<std::string>& list, const std::string& part) {
    return std::any_of(list.begin(), list.end(),
                       [&](auto& line) { return line.find(part) != std::string::npos; });
}

/// The rows without their source.
std::string rows_of(const std::string& text, const std::vector<std::string>& told = {"axis=X"}) {
    std::string rows = imported(import_bench::setup(), {iso, text, told, ""}).readings;
    for (std::size_t at; (at = rows.find("f.txt:")) != std::string::npos;)
        rows.erase(at, rows.find('\n', at) - at);
    return rows;
}

std::set<int> sides(const std::string& text, const std::vector<std::string>& told) {
    std::set<int> found;
    std::vector<std::string> notes;
    const auto table = records::parse_readings(
        imported(import_bench::setup(), {iso, text, told, ""}).readings, "r.csv", notes);
    for (const auto& point : records::deviation_points(table, "X")) found.insert(point.direction);
    return found;
}

}  // namespace

TEST_CASE("names of ISO 230-2, Roman runs and marks of thousands are read", "[imports][ways]") {
    const std::string expected = rows_of(one_table);
    const auto with_names = [](const std::string& names) {
        return names + one_table.substr(one_table.find("\n0,"));
    };
    CHECK(rows_of(with_names("target [mm],I+ [um],I- [um],II+ [um],II- [um]")) == expected);
    CHECK(rows_of(with_names("P_i [mm],1+ [um],1- [um],2+ [um],2- [um]")) == expected);
    // An index, a mean and a reversal value are no readings.
    CHECK(rows_of("i,P_i [mm],1+ [um],1- [um],2+ [um],2- [um],x\xCC\x84_i [um],B_i [um]\n"
                  "1,0,0,3,0.4,3.4,1.7,3\n2,100,1,5,1.4,5.4,3.2,4\n3,200,2,4,2.4,4.4,3.2,2\n") ==
          expected);
    const std::string list = rows_of("target [mm];error [um]\n900;0,1\n1000;0,2\n1234567;0,3\n");
    CHECK(rows_of("target [mm]\terror [um]\n900.0\t0.1\n1,000.0\t0.2\n1,234,567.0\t0.3\n") == list);
    CHECK(rows_of("target [mm];error [um]\n900,0;0,1\n1.000,0;0,2\n1.234.567,0;0,3\n") == list);
    CHECK(rows_of("target [mm],error [um]\n900.0,0.1\n\"1,000.0\",0.2\n\"1,234,567.0\",0.3\n") ==
          list);
    refuses(import_bench::setup(),
            {iso, "target [mm];error [um]\n900,0;0,1\n10.00,0;0,2\n", {"axis=X"}, ""}, "10.00,0",
            3);
}

TEST_CASE("two tables with the two directions of an axis are one test", "[imports][ways]") {
    const std::string expected = rows_of(one_table);
    const std::string plus = "target [mm],1+ [um],2+ [um]\n" + up,
                      minus = "target [mm],1- [um],2- [um]\n" + down,
                      plain = "target [mm],run 1 [um],run 2 [um]\n";
    CHECK(rows_of(plus + "\n" + minus) == expected);
    CHECK(rows_of(minus + "\n" + plus) == expected);
    CHECK(rows_of("Direction: forward\n" + plain + up + "\nDirection: backward\n" + plain + down) ==
          expected);
    CHECK(rows_of("## Data forward direction\n" + plain + up + "## Data backward direction\n" +
                  plain + down) == expected);
    CHECK(rows_of("Forward\n" + plain + up + ";Reverse;;\n" + plain + down) == expected);
    CHECK(rows_of("Richtung: +\n" + plain + up + "\nRichtung: X-\n" + plain + down) == expected);
    CHECK(has(imported(import_bench::setup(), {iso, plus + "\n" + minus, {"axis=X"}, ""}).notes,
              "the two directions of one test"));
}

TEST_CASE("columns of runs stand in the order of measurement where their numbers rise",
          "[imports][ways]") {
    // Down, up, down: the positions of the first row of each pass tell it.
    const auto passes = [](const std::string& names) {
        std::vector<int> ways;
        double before = 0.0;
        const Case c{
            iso, "target [mm]," + names + "\n0,1,2,3\n100,1,2,3\n200,1,2,3\n", {"axis=X"}, ""};
        for (const records::Reading& row : import_bench::rows(import_bench::setup(), c).rows) {
            if (row.device == records::Device::none)
                ways.push_back(0);
            else if (ways.back() == 0)
                ways.back() = row.commanded[Axis::X] > before ? 1 : -1;
            before = row.commanded[Axis::X];
        }
        return ways;
    };
    CHECK(passes("1- [um],1+ [um],2- [um]") == std::vector{-1, 1, -1});
    CHECK(passes("1+ [um],1- [um],2+ [um]") == std::vector{1, -1, 1});
    CHECK(passes("1+ [um],2+ [um],1- [um]") == std::vector{1, -1, 1});
}

// A decay length must not come from a way that nobody drove.
TEST_CASE("an invented approach is no longer than a step", "[imports][ways]") {
    for (const auto& [step, way] : {std::pair{0.01, 0.01}, std::pair{25.0, 1.0}}) {
        std::string text = "target [mm],1+ [um],1- [um]\n";
        for (int k = 0; k < 5; ++k) text += std::to_string(step * k) + ",1,2\n";
        const auto all =
            import_bench::rows(import_bench::setup(), {iso, text, {"axis=X"}, ""}).rows;
        CHECK(all[0].device == records::Device::none);
        CHECK(all[1].commanded[Axis::X] - all[0].commanded[Axis::X] == Approx(way));
    }
}

TEST_CASE("the two directions in two files keep two zeros, with a note", "[imports][ways]") {
    const setup::Setup setup = import_bench::setup();
    const std::vector<imports::ImportFile> files{{"a.txt", "target [mm],1+ [um]\n0,0\n100,1\n"},
                                                 {"b.txt", "target [mm],1- [um]\n0,0\n100,1\n"}};
    const imports::Imported result =
        imports::import_readings(iso, {setup, files, imports::Facts({"axis=X"}), {}});
    CHECK_THAT(result.readings, Catch::Contains(",X_2,linear"));
    CHECK(has(result.notes, "a.txt and b.txt: the two directions of X in two files"));
}

TEST_CASE("displacements of two tables count from one zero", "[imports][ways]") {
    const auto rows = read_rows(import_bench::setup(),
                                {iso,
                                 "target [mm],1+ [mm]\n100,0\n200,100.001\n300,200.002\n\n"
                                 "target [mm],1- [mm]\n100,0.004\n200,100.005\n300,200.006\n",
                                 {"axis=X"},
                                 ""});
    REQUIRE(rows.size() == 6);
    CHECK(*rows[5].value_mm == Approx(0.004));
    CHECK(rows[5].test == "X");
}

TEST_CASE("tables of other targets, sessions or one direction stay apart", "[imports][ways]") {
    const setup::Setup setup = import_bench::setup();
    const std::string first = "target [mm],1+ [um]\n0,0\n100,1\n";
    for (const char* second :
         {"target [mm],1+ [um]\n0,0\n100,1.2\n", "target [mm],1- [um]\n0,0\n150,1\n",
          "Date: 2024-03-02\ntarget [mm],1- [um]\n0,0\n100,1\n"}) {
        INFO(second);
        const auto rows = read_rows(setup, {iso, first + second, {"axis=X"}, ""});
        CHECK(rows.back().test == "X_2");
    }
}

TEST_CASE("a direction above a table is understood or refused", "[imports][ways]") {
    const setup::Setup setup = import_bench::setup();
    const std::string plain = "target [mm],run 1 [um],run 2 [um]\n" + up;
    CHECK(sides("Direction: backward\n" + plain, {"axis=X"}) == std::set<int>{-1});
    CHECK(sides(plain, {"axis=X", "sense=down"}) == std::set<int>{-1});
    CHECK(sides(plain, {"axis=X"}) == std::set<int>{1});
    refuses(setup, {iso, "Direction: bidirectional\n" + plain, {"axis=X"}, ""},
            "the runs have no direction", 2);
    refuses(setup, {iso, "Direction: sideways\n" + plain, {"axis=X"}, ""},
            "the runs have no direction", 2);
    refuses(setup, {iso, "Direction: backward\n" + one_table, {"axis=X"}, ""},
            "contradicts the direction 'backward'", 2);
    refuses(setup, {iso, one_table, {"axis=X", "sense=sideways"}, ""}, "not 'sideways'", 0);
    refuses(setup, {iso, "Direction: forward\nData backward direction\n" + plain, {"axis=X"}, ""},
            "contradicts the direction 'forward'", 2);
    CHECK(rows_of("Direction: bidirectional\n" + one_table) == rows_of(one_table));
    CHECK(rows_of("Pass 1\n" + one_table) == rows_of(one_table));
    refuses(setup,
            {iso,
             "Direction: backward\ntarget [mm],error [um]\n0,1\n100,2\n200,3\n200,4\n100,5\n0,6\n",
             {"axis=X"},
             ""},
            "contradicts the direction 'backward'", 3);
}

TEST_CASE("a heading of other words names the direction of the tables below it",
          "[imports][ways]") {
    const setup::Setup setup = import_bench::setup();
    const std::string plain = "target [mm],run 1 [um],run 2 [um]\n",
                      list = "target [mm],error [um]\n0,1\n100,2\n200,3\n";
    const std::string first = "## Error by Sensor AB12 Positive Direction\n\n",
                      second = "## Error by Sensor AB12 Negative Direction\n\nAt 3 positions.\n";
    CHECK(rows_of(first + plain + up + second + plain + down) == rows_of(one_table));
    CHECK(has(imported(setup, {iso, second + list, {"axis=X"}, ""}).notes,
              "the heading of line 1 tells the direction: negative"));
    for (const char* heading :
         {"# Stage 4, backward travel", "Table 3 - Backward", "## Lauf 2, Richtung negativ",
          "* Test 7 in X- direction at 20 degC", "## Reverse pass of the second day"}) {
        INFO(heading);
        CHECK(sides(heading + ("\n" + list), {"axis=X"}) == std::set<int>{-1});
    }
    for (const char* remark :
         {"# all numbers are negative", "# back up 12", "# after a warm up run",
          "# positive and negative direction", "# the laser was moved back by 3 mm",
          "# pass forward; then pass 2"}) {
        INFO(remark);
        CHECK(sides(remark + ("\n" + list), {"axis=X"}) == std::set<int>{1});
    }
    // A heading with both directions ends what the one before told.
    CHECK(has(
        imported(
            setup,
            {iso, second + list + "## Positive and negative direction\n" + list, {"axis=X"}, ""})
            .notes,
        "no direction is told: towards +"));
    // It is not that of a table whose names tell both; one whose names tell the other is refused.
    CHECK(rows_of("# positive direction: away from the motor\n# positive direction away from it\n" +
                  one_table) == rows_of("\n\n" + one_table));
    refuses(setup, {iso, second + "target [mm],1+ [um],2+ [um]\n" + up, {"axis=X"}, ""},
            "contradicts the direction 'negative'", 5);
}

TEST_CASE("a direction in a heading ends with its section", "[imports][ways]") {
    const setup::Setup setup = import_bench::setup();
    const std::string list = "target [mm],error [um]\n0,1\n100,2\n200,3\n",
                      other = "target [mm],error [um]\n0,4\n100,1\n200,2\n",
                      by_order = "no direction is told: towards +";
    for (const auto& [first, second] :
         {std::pair{"## Data backward direction\n\n", "\n## Second day\n\n"},
          std::pair{"### Data backward direction\n\n", "\n# Second day\n\nAt 3 positions.\n"},
          std::pair{"Backward sequence\n", "\nSecond day\n"},
          std::pair{"# Data backward direction\n\n# Second day\n\n", "\n"}}) {
        INFO(first << second);
        CHECK(has(imported(setup, {iso, first + list + second + other, {"axis=X"}, ""}).notes,
                  by_order));
    }
    for (const auto& [first, second] :
         {std::pair{"# Backward travel\n\n## Sensor one\n\n", "\n## Sensor two\n\n"},
          std::pair{"# Backward travel\n# of the stage\n\n", "\nAt 3 positions.\n"}}) {
        INFO(first << second);
        CHECK_FALSE(has(imported(setup, {iso, first + list + second + other, {"axis=X"}, ""}).notes,
                        by_order));
        CHECK(sides(first + list + second + other, {"axis=X"}) == std::set<int>{-1});
    }
}

TEST_CASE("a direction that only the order of the targets tells is told", "[imports][ways]") {
    const setup::Setup setup = import_bench::setup();
    const std::string rising = "0,1,1\n100,2,2\n200,3,3\n", falling = "200,3,3\n100,2,2\n0,1,1\n";
    for (const std::string names : {"target [mm],error [um],n\n", "target [mm],run 1 [um],n\n"}) {
        INFO(names);
        CHECK(sides(names + rising, {"axis=X"}) == std::set<int>{1});
        CHECK(sides(names + falling, {"axis=X"}) == std::set<int>{-1});
        CHECK(has(imported(setup, {iso, names + falling, {"axis=X"}, ""}).notes,
                  "towards -, by the order of the targets"));
        CHECK(has(imported(setup, {iso, names + rising, {"axis=X"}, ""}).notes,
                  "towards +, by the order of the targets"));
        CHECK_FALSE(has(imported(setup, {iso, names + falling, {"axis=X", "sense=-"}, ""}).notes,
                        "by the order"));
        CHECK_FALSE(has(
            imported(setup, {iso, "Direction: backward\n" + names + falling, {"axis=X"}, ""}).notes,
            "by the order"));
    }
    CHECK_FALSE(has(imported(setup, {iso, one_table, {"axis=X"}, ""}).notes, "by the order"));
}

TEST_CASE("passes that all begin at the first target have one direction", "[imports][ways]") {
    const std::string with_runs =
        "run,target [mm],error [um]\n1,0,0\n1,100,1\n1,200,2\n2,0,0.4\n2,100,1.4\n2,200,2.4\n";
    const std::string without =
        "target [mm],error [um]\n0,0\n100,1\n200,2\n0,0.4\n100,1.4\n200,2.4\n0,0.2\n";
    const std::string two_targets =
        "run,target [mm],error [um]\n1,0,0\n1,100,1\n2,0,0.4\n2,100,1.4\n";
    for (const std::string& text : {with_runs, without, two_targets}) {
        INFO(text);
        CHECK(sides(text, {"axis=X"}) == std::set<int>{1});
        const auto result = imported(import_bench::setup(), {iso, text, {"axis=X"}, ""});
        CHECK(has(result.summary, "runs one way"));
        CHECK(has(result.summary, "only towards +: E "));
    }
    CHECK(has(imported(import_bench::setup(), {iso, with_runs, {"axis=X"}, ""}).summary,
              "2 runs one way at 3 targets"));
    CHECK(sides("Direction: backward\n" + with_runs, {"axis=X"}) == std::set<int>{-1});
    CHECK(sides("run,target [mm],error [um]\n1,200,0\n1,100,1\n1,0,2\n2,200,0\n2,100,1\n2,0,2\n",
                {"axis=X"}) == std::set<int>{-1});
}

TEST_CASE("a turn after a missing reading is a turn", "[imports][ways]") {
    const auto table = import_bench::rows(
        import_bench::setup(),
        {iso, "target [mm],error [um]\n0,0\n100,1\n200,2\n300,3\n100,5\n0,6\n", {"axis=X"}, ""});
    const auto points = records::deviation_points(table, "X");
    REQUIRE(points.size() == 6);
    CHECK(points[4].direction == -1);
    CHECK(points[5].direction == -1);
}

TEST_CASE("figures of one direction", "[imports][ways]") {
    // Means 0.2, 1.2, 2.2; every s = 0.28284: E 2, R 4 s = 1.13, A 2 + 4 s = 3.13.
    const auto result = imported(import_bench::setup(),
                                 {iso, "target [mm],1- [um],2- [um]\n" + up, {"axis=X"}, ""});
    CHECK(has(result.summary, "ISO 230-2, only towards -: E 2.00, R 1.13, A 3.13 µm"));
}

TEST_CASE("a backward pass listed from the first target on is read in reverse", "[imports][ways]") {
    const std::string head = "run,direction,target [mm],error [um]\n",
                      forward = "1,+,0,0\n1,+,100,1\n1,+,200,2\n",
                      against = "1,-,0,3\n1,-,100,5\n1,-,200,4\n",
                      right = "1,-,200,4\n1,-,100,5\n1,-,0,3\n";
    CHECK(rows_of(head + forward + against) == rows_of(head + forward + right));
    CHECK(
        has(imported(import_bench::setup(), {iso, head + forward + against, {"axis=X"}, ""}).notes,
            "read in reverse"));
    // With times of its own the order is that of the file.
    refuses(import_bench::setup(),
            {iso, "time [s]," + head + "0,1,-,0,3\n1,1,-,100,5\n2,1,-,200,4\n", {"axis=X"}, ""},
            "targets out of order", 3);
}

TEST_CASE("a clock that is invented is always told", "[imports][ways]") {
    const setup::Setup setup = import_bench::setup();
    const std::string across = "Position [mm];0;100;200\nRun 1 up;0,1;0,3;0,2\nRun 1 down;1;1;3\n";
    for (const Case& c :
         {Case{iso, one_table, {"axis=X"}, ""}, Case{iso, across, {"axis=X", "unit=um"}, ""},
          Case{iso, "target [mm],error [um]\n0,0\n1,1\n", {"axis=X"}, ""}}) {
        INFO(c.text);
        CHECK(has(imported(setup, c).notes, "no times: rows one minute apart"));
        Case with_step = c;
        with_step.told.emplace_back("step_s=5");
        CHECK_FALSE(has(imported(setup, with_step).notes, "one minute"));
    }
}

TEST_CASE("positions without a unit are in that of their targets, never in another",
          "[imports][ways]") {
    const setup::Setup setup = import_bench::setup();
    const std::string positions = "target,1+,1-\n0,0.001,0.003\n100,100.002,100.004\n200,200,200\n",
                      deviations = "target,1+,1-\n0,1,3\n100,2,4\n";
    CHECK(*read_rows(setup, {iso, positions, {"axis=X"}, ""})[1].value_mm == Approx(0.002));
    refuses(setup, {iso, positions, {"axis=X", "unit=um"}, ""}, "the numbers of the targets", 1);
    refuses(setup,
            {iso,
             "Position;0;100;200\nRun 1 up;0,1;100,3;200,2\nRun 1 down;0,2;100,1;200,3\n",
             {"axis=X", "unit=um"},
             ""},
            "the numbers of the targets", 1);
    CHECK(*read_rows(setup, {iso, positions, {"axis=X", "unit=um", "values=deviations"}, ""})[1]
               .value_mm == Approx(0.100002));
    CHECK(has(imported(setup, {iso, deviations, {"axis=X", "unit=um"}, ""}).notes,
              "'target' without unit taken as mm; unit um is that of the values"));
    CHECK_FALSE(has(imported(setup, {iso, one_table, {"axis=X"}, ""}).notes, "without unit"));
}

TEST_CASE("the report of a stage test: indices in the names, a date of Unix", "[imports][ways]") {
    const std::string names =
        "i |tgt_pos(i) [mm]|ref_pos(i,1) [mm]|ref_pos(i,2) [mm]|\n--- |--- |--- |--- |\n";
    const auto rows = read_rows(import_bench::setup(),
                                {iso,
                                 "# Report\n* Date : Wed Apr 13 14:00:34 CEST 2022\n"
                                 "## Data forward direction\n" +
                                     names +
                                     "1|0.0|0.001|0.002|\n2|100.0|100.001|Out of range|\n"
                                     "## Data backward direction\n" +
                                     names + "1|0.0|0.004|0.005|\n2|100.0|100.004|100.005|\n",
                                 {"axis=X"},
                                 ""});
    REQUIRE(rows.size() == 7);
    CHECK(rows[0].session == "2022-04-13");
    CHECK(rows[6].test == "X");
    CHECK(*rows[6].value_mm == Approx(0.005));
}

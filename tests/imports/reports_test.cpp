// Whole reports of stage tests: the column that is measured, headings with directions, and tables
// without readings between and behind those with readings.
#include <algorithm>

#include "tests/imports/import_bench.h"

using namespace trunnion;
using import_bench::Case;
using import_bench::imported;
using import_bench::read_rows;
using import_bench::refuses;

namespace {

constexpr auto iso = imports::ImportKind::iso230_2;

bool has(const std::vector<std::string>& list, const std::string& part) {
    return std::any_of(list.begin(), list.end(),
                       [&](auto& line) { return line.find(part) != std::string::npos; });
}

const std::string rule = "--- | --- | --- | --- | --- | --- | --- |\n";
const std::string names =
    "j (cycle)| i (pos id)| Tgt_pos [mm] | Motor_pos [mm] | Resolver_pos [mm] | Reference [mm] | "
    "Diff ref-tgt, X(i,j) [mm]\n";
const std::string indexed =
    "j (cycle)| i (pos id)| Tgt_pos(i) [mm] | Motor_pos(i) [mm] | Resolver_pos(i) [mm] | "
    "Reference(i) [mm] | Diff ref-tgt, X(i,j) [mm]\n";
const std::string forward =
    "1 | 1 | 10.0 | 10.001 | 10.031 | 10.004 | .004 |\n"
    "1 | 2 | 20.0 | 20.001 | 20.031 | 20.006 | .006 |\n"
    "1 | 3 | 30.0 | 30.001 | 30.030 | 30.003 | .003 |\n"
    "2 | 1 | 10.0 | 10.001 | 10.031 | 10.005 | .005 |\n"
    "2 | 2 | 20.0 | 20.001 | 20.031 | 20.007 | .007 |\n"
    "2 | 3 | 30.0 | 30.001 | 30.030 | 30.002 | .002 |\n";
const std::string backward =
    "1 | 1 | 10.0 | 9.999 | 10.011 | 10.008 | .008 |\n"
    "1 | 2 | 20.0 | 19.999 | 20.011 | 20.009 | .009 |\n"
    "1 | 3 | 30.0 | 29.999 | 30.010 | 30.007 | .007 |\n"
    "2 | 1 | 10.0 | 9.999 | 10.011 | 10.010 | .010 |\n"
    "2 | 2 | 20.0 | 19.999 | 20.011 | 20.008 | .008 |\n"
    "2 | 3 | 30.0 | 29.999 | 30.010 | 30.006 | .006 |\n";
const std::string ratios =
    "# Gear Ratios\nFrom | To | Ratio [] | Offset [mm] | Data count [] | Residual error [mm²]\n"
    "--- | --- | --- | --- | --- | --- |\n"
    "Openloop | Resolver | -.9 | 6.5 | 240.0 | .5\nOpenloop | Laser (AB1) | 1.0 | 8.5 | 230.0 | "
    ".4\n\n";
const std::string means =
    "# Mean Position Deviation and Reversal Error\n\nX_fwd(i) = Mean deviation (fwd dir)\n\n"
    "i (pos id) | Tgt_pos(i) [mm] | X_fwd(i) [mm] | X_bwd(i) [mm] | X_avg(i) [mm] | B(i) [mm]\n"
    "--- | --- | --- |--- |--- |--- |\n1 | 10.0 | .0045 | .009 | .00675 | -.0045\n"
    "2 | 20.0 | .0065 | .0085 | .0075 | -.002\n3 | 30.0 | .0025 | .0065 | .0045 | -.004\n\n"
    "B = Axis Reversal Error [mm]: .0045\n";

/// The rows without their source and session.
std::string rows_of(const std::string& text) {
    std::string rows = imported(import_bench::setup(), {iso, text, {"axis=X"}, ""}).readings;
    for (std::size_t at; (at = rows.find("f.txt:")) != std::string::npos;)
        rows.erase(at, rows.find('\n', at) - at);
    return rows;
}

/// The deviation at the last of three targets.
void takes(const std::string& columns, double value_mm, const std::string& note) {
    INFO(columns);
    const setup::Setup setup = import_bench::setup();
    const Case c{iso,
                 columns + "\n1,10,10.001,10.007,7\n2,20,20.002,20.008,8\n3,30,30.002,30.009,9\n",
                 {"axis=X"},
                 ""};
    CHECK(*read_rows(setup, c).back().value_mm == Approx(value_mm));
    CHECK(has(imported(setup, c).notes, note));
}

}  // namespace

TEST_CASE("the deviation of the reference is read, not the axis's own sensors",
          "[imports][reports]") {
    const setup::Setup setup = import_bench::setup();
    for (const std::string& head : {names, indexed}) {
        const Case c{iso, "# Forward test sequence\n\n" + head + rule + forward, {"axis=X"}, ""};
        INFO(head);
        const auto rows = read_rows(setup, c);
        REQUIRE(rows.size() == 6);
        CHECK(*rows[0].value_mm == Approx(0.004));
        CHECK(*rows[5].value_mm == Approx(0.002));
        const auto result = imported(setup, c);
        CHECK(has(result.notes, "'Diff ref-tgt, X(i,j)' taken as the value, not 'Motor_pos"));
        CHECK_FALSE(has(result.notes, "without a value"));
        CHECK(has(result.summary, "2 runs one way at 3 targets"));
    }
}

TEST_CASE("instruments come before the sensors of the axis", "[imports][reports]") {
    takes("n,target [mm],Resolver_pos [mm],Reference [mm],p", 0.009,
          "'Reference' taken as the value, not 'Resolver_pos'");
    takes("n,target [mm],motor pos [mm],laser [mm],p", 0.009, "'laser' taken as the value");
    takes("n,target [mm],encoder [mm],measured [mm],p", 0.009,
          "'measured' taken as the value, not 'encoder'");
    takes("n,target [mm],Resolver_pos(i) [mm],p,Motor diff [um]", 0.002,
          "'Resolver_pos(i)' taken as the value, not 'Motor diff'");
    takes("n,target [mm],actual [mm],laser position [mm],p", 0.009,
          "'laser position' taken as the value, not 'actual'");
    takes("n,target (mm),Encoder (i) (mm),Laser (i) (mm),p", 0.009,
          "'Laser (i)' taken as the value, not 'Encoder (i)'");
    takes("n,setpoint [mm],motor [mm],reference [mm],p", 0.009, "'reference' taken as the value");
    // The other sign: the position of the reference is read instead.
    takes("n,target [mm],Motor [mm],Reference [mm],Diff tgt-ref [um]", 0.009,
          "'Reference' taken as the value, not 'Motor'");
    takes("n,target [mm],p [mm],q [mm],Soll-Ist-Abweichung [um]\n", 0.009, "");
    refuses(import_bench::setup(),
            {iso, "target [mm],Diff tgt-ref [um]\n0,1\n10,2\n", {"axis=X"}, ""},
            "no column of deviations", 1);
}

TEST_CASE("headings with a direction make one test of two tables", "[imports][reports]") {
    const setup::Setup setup = import_bench::setup();
    const std::string expected = rows_of("# Data forward direction\n" + names + rule + forward +
                                         "# Data backward direction\n" + names + rule + backward);
    CHECK(expected.find("X_2") == std::string::npos);
    for (const auto& [up, down] :
         {std::pair{"# Forward test sequence", "# Backward test sequence"},
          std::pair{"## Ascending", "## Descending"}, std::pair{"Sequence up", "Sequence down"},
          std::pair{"# Positive series", "# Negative series"},
          std::pair{"# Fwd test", "# Bwd test"},
          std::pair{"# Messreihe steigend", "# Messreihe fallend"},
          std::pair{"# Test 3, forward sequence", "# Test 3, backward sequence"}}) {
        INFO(up);
        const std::string text = std::string(up) + "\n\n" + names + rule + forward + "\n\n" + down +
                                 "\n\n" + indexed + rule + backward;
        CHECK(rows_of(text) == expected);
        const auto result = imported(setup, {iso, text, {"axis=X"}, ""});
        CHECK(has(result.summary, "2 runs both ways at 3 targets"));
        CHECK(has(result.notes, "two directions of one test"));
    }
}

TEST_CASE("tables without readings are passed over, with their line and heading",
          "[imports][reports]") {
    const setup::Setup setup = import_bench::setup();
    const std::string readings = "# Forward test sequence\n\n" + names + rule + forward +
                                 "\n# Backward test sequence\n" + indexed + rule + backward + "\n";
    const std::string expected = rows_of(readings);
    const std::string text = "# Report\n\n" + ratios + readings + means;
    CHECK(rows_of(text) == expected);
    const auto notes = imported(setup, {iso, text, {"axis=X"}, ""}).notes;
    CHECK(has(notes, "the table of line 4 ('Gear Ratios') has no readings"));
    CHECK(has(notes, "the table of line 34 ('Mean Position Deviation and Reversal Error')"));
    // Deviations again, and the figures of each target.
    for (const std::string more :
         {"## Calculations\n### Deviation forward direction\n"
          "i |x(i,1) [mm]|x(i,2) [mm]|x_avg(i) [mm]|\n--- |--- |--- |--- |\n"
          "1|.004|.005|.0045|\n2|.006|.007|.0065|\n3|.003|.002|.0025|\n",
          "## Calculations\n### Deviation backward direction\n"
          "i |target [mm]|1- [mm]|2- [mm]|\n--- |--- |--- |--- |\n"
          "1|10|.008|.010|\n2|20|.009|.008|\n3|30|.007|.006|\n",
          "Mean deviations\ntarget [mm]|+ [mm]|- [mm]|\n10|.0045|.009\n20|.0065|.0085\n",
          "Standard deviations\ntarget [mm]|+ [mm]|- [mm]|\n10|.0045|.009\n20|.0065|.0085\n",
          "# Drift\nposition [mm]|temperature|\n10|20.5\n20|20.6\n",
          "# Reversal\ntarget [mm]|B [mm]|\n10|.0045\n20|.0065\n"}) {
        INFO(more);
        CHECK(rows_of(readings + more) == expected);
        CHECK(has(imported(setup, {iso, readings + more, {"axis=X"}, ""}).notes, "passed over"));
    }
}

TEST_CASE("a table of readings that is broken is refused beside good ones", "[imports][reports]") {
    const setup::Setup setup = import_bench::setup();
    const std::string good = "# Forward test sequence\n" + names + rule + forward + "\n";
    const auto broken = [&](const std::string& more, const std::string& part, int line) {
        refuses(setup, {iso, good + more, {"axis=X"}, ""}, part, line);
    };
    broken("# Backward test sequence\ni|target [mm]|what [mm]|\n1|10|1\n2|20|2\n",
           "no column of deviations", 12);
    broken("# Backward test sequence\nplace|1- [mm]|2- [mm]|\n10|1|1\n20|2|2\n",
           "no column of targets", 12);
    broken("# Backward test sequence\ntarget [mm]|1- [mm]|2- [mm]|\n10|1|x\n20|2|2\n", "'x' is not",
           13);
    // Nothing but tables without readings: the one with targets tells what is wrong.
    refuses(setup, {iso, ratios + means, {"axis=X"}, ""}, "no column of deviations", 11);
    refuses(setup, {iso, ratios, {"axis=X"}, ""}, "no column of targets", 2);
}

TEST_CASE("readings that a report lists again are read once", "[imports][reports]") {
    const setup::Setup setup = import_bench::setup();
    const std::string positions =
        "target [mm],1+ [mm],1- [mm]\n0,0.00042,0.00318\n100,100.00144,100.00523\n"
        "200,200.00251,200.00405\n";
    const std::string deviations =
        "target [mm],1+ [um],1- [um]\n0,0.4,3.2\n100,1.4,5.2\n200,2.5,4.0\n";
    const Case c{iso, "# Positions\n" + positions + "# Deviations\n" + deviations, {"axis=X"}, ""};
    CHECK(read_rows(setup, c).size() == 6);
    CHECK(has(imported(setup, c).notes,
              "the table of line 7 repeats the readings of line 2: passed over"));
    const std::string others = "target [mm],1+ [um],1- [um]\n0,0.9,3.2\n100,1.4,5.2\n200,2.5,4.0\n";
    CHECK(read_rows(setup, {iso, positions + others, {"axis=X"}, ""}).size() == 12);
}

TEST_CASE("results are the readings of a file without others", "[imports][reports]") {
    const setup::Setup setup = import_bench::setup();
    const std::string table = "target [mm],1+ [um],1- [um]\n0,0,3\n100,1,5\n";
    for (const std::string heading : {"# Results\n", "# Measurement results X axis\n",
                                      "# ISO 230-2 results\n## Mean temperature 20.5 degC\n"}) {
        INFO(heading);
        const auto rows = read_rows(setup, {iso, heading + table, {"axis=X"}, ""});
        CHECK(rows.size() == 4);
    }
    CHECK(read_rows(setup, {iso, "# Results\n" + table + "# Mean values\n" + table, {"axis=X"}, ""})
              .size() == 4);
    // A remark on the mean of something else.
    const std::string warmer = "target [mm],1+ [um],1- [um]\n0,0.2,3.1\n100,1.4,5.3\n";
    CHECK(read_rows(setup, {iso, table + "# Mean temperature 20.5\n" + warmer, {"axis=X"}, ""})
              .size() == 8);
}

TEST_CASE("what a report tells of other things is no test of the axis", "[imports][reports]") {
    const setup::Setup setup = import_bench::setup();
    const std::string head =
        "i |tgt_pos(i) [mm]|ref_pos(i,1) [mm]|ref_pos(i,2) [mm]|\n--- |--- |--- |--- |\n";
    const std::string readings =
        "# Stage test\n\n## Data forward direction\n\n" + head +
        "1|10.0|10.003|10.004|\n2|20.0|20.001|20.002|\n3|30.0|29.997|29.996|\n\n"
        "## Data backward direction\n\n" +
        head + "1|10.0|10.013|10.012|\n2|20.0|20.009|20.011|\n3|30.0|29.991|29.992|\n\n";
    const std::string results =
        "## Calculations\n\n### Deviation backward direction\n\n"
        "i |x(i,1) [mm]|x(i,2) [mm]|x_avg(i) [mm]|\n--- |--- |--- |--- |\n"
        "1|.013|.012|.0125|\n2|.009|.011|.010|\n3|-.009|-.008|-.0085|\n\n";
    const std::string expected = rows_of(readings);
    for (const std::string columns :
         {"Test | Setpoint [mm] | Resolver AVG[mm] | Diff [mm] | Resolver STD[mm]\n",
          "Test | Setpoint [mm] | Resolver [mm] | Diff [mm] | Turn []\n"}) {
        const std::string others =
            "# Resolver Performance\n\n## Over one turn\nAt 3 positions.\n\n" + columns +
            "--- | --- | --- | --- | --- |\n1 | 12.0 | 11.9 | -.1 | .02\n"
            "2 | 14.0 | 13.8 | -.2 | .03\n3 | 16.0 | 15.9 | -.1 | .02\n";
        INFO(columns);
        CHECK(rows_of(readings + results + others) == expected);
        CHECK(has(imported(setup, {iso, readings + results + others, {"axis=X"}, ""}).notes,
                  "('Over one turn') is no test of the axis as the others of this file are"));
        // Alone it is what the file has; the axis that is told above it is its own.
        CHECK(read_rows(setup, {iso, others, {"axis=X"}, ""}).size() == 3);
        const auto all =
            read_rows(setup, {iso, "Axis: X\n" + readings + "Axis: Y\n" + others, {}, ""});
        CHECK(all.back().test == "Y");
    }
    // Lists beside lists: means, and what a sensor of the axis reads.
    const std::string list = "# Laser\ntarget [mm],error [um]\n0,1\n100,2\n200,3\n";
    for (const std::string more :
         {"# Summed up\ntarget [mm],error [um],avg [um]\n0,1,2\n100,2,3\n200,4,3\n",
          "# Resolver\ntarget [mm],error [um]\n0,2\n100,5\n200,4\n"})
        CHECK(rows_of(list + more) == rows_of(list));
}

// Goldens: which rows a path becomes, and what is refused when one is read.
#include "regression/golden.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "base/alarm.h"
#include "base/units.h"
#include "tests/regression/paths.h"

using namespace trunnion;
using namespace trunnion::testing;

namespace {

/// The rows without the head, and without what follows the position.
std::vector<std::string> rows_of(Pen& pen) {
    const std::string text = regression::format_golden(pen.done(), {});
    std::vector<std::string> rows;
    for (std::size_t at = 0, end = 0; at < text.size(); at = end + 1) {
        end = text.find('\n', at);
        const std::string row = text.substr(at, end - at);
        if (row.starts_with("#") || row.starts_with("motion")) continue;
        std::size_t comma = 0;
        for (int k = 0; k < 9; ++k) comma = row.find(',', comma + 1);
        rows.push_back(row.substr(0, comma));
    }
    return rows;
}

const std::string head =
    "# schema = trunnion.golden/1\n"
    "motion,tool,feed_mm_min,spindle_rpm,coolant,mode,x_mm,y_mm,z_mm,tool_i,tool_j,tool_k,"
    "center_x_mm,center_y_mm,center_z_mm,normal_x,normal_y,normal_z,sweep_deg\n";
const std::string start = "START,1,0,8000,0,0,0,0,0,0,0,1,,,,,,,\n";
const std::string row = "G1,1,500,8000,0,0,1,2,3,0,0,1,,,,,,,\n";

/// Line, column and text of the refusal.
std::string refusal(const std::string& text) {
    try {
        regression::parse_golden(text, "g.csv");
    } catch (const InputError& error) {
        return std::to_string(error.where.line) + ":" + std::to_string(error.where.column) + " " +
               error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("lines that go on the same way with everything the same are one row", "[golden]") {
    Pen pen;
    pen.at(0, 0, 0).cut(1, 0, 0).cut(2, 0, 0).cut(3, 0, 0).cut(2, 0, 0).cut(2, 5, 0);
    CHECK(rows_of(pen) ==
          std::vector<std::string>{"START,1,0,8000,0,0,0,0,0", "G1,1,500,8000,0,0,3,0,0",
                                   "G1,1,500,8000,0,0,2,0,0", "G1,1,500,8000,0,0,2,5,0"});
}

TEST_CASE("whatever changes on a straight way begins a new row", "[golden]") {
    using Change = void (*)(regression::Segment&);
    const Change change = GENERATE(
        values<Change>({[](regression::Segment& s) { s.tool = 2; },
                        [](regression::Segment& s) { s.feed_mm_min = 510.0F; },
                        [](regression::Segment& s) { s.spindle_rpm = 8100.0F; },
                        [](regression::Segment& s) { s.coolant = true; },
                        [](regression::Segment& s) { s.mode = 1; },
                        [](regression::Segment& s) { s.turning = true; },
                        [](regression::Segment& s) {
                            s.end_orientation = {0.0, 0.6, 0.8};
                        },
                        [](regression::Segment& s) { s.kind = regression::SegmentKind::rapid; },
                        [](regression::Segment& s) { s.kind = regression::SegmentKind::jump; }}));
    Pen same, changed;
    for (Pen* pen : {&same, &changed}) {
        pen->at(0, 0, 0).cut(1, 0, 0).cut(2, 0, 0);
        regression::Segment s = pen->segment(regression::SegmentKind::feed, 3, 0, 0);
        if (pen == &changed) change(s);
        pen->add(s);
        s.end_mm[0] = 4.0;  // goes on as changed
        pen->add(s);
        pen->cut(5, 0, 0);
    }
    CHECK(rows_of(same).size() == 2);
    CHECK(rows_of(changed).size() >= 4);
    CHECK(rows_of(changed).back() == "G1,1,500,8000,0,0,5,0,0");
}

TEST_CASE("an arc is a row of its own before and behind a line", "[golden]") {
    Pen pen;
    pen.at(10, 0, 0).arc(-10, 0, 0, {0, 0, 0}, pi).cut(-10, -5, 0).cut(-10, -9, 0);
    pen.arc(-10, -9, -1e-9, {-5, -9, 0}, 2.0 * pi);
    const std::string text = regression::format_golden(pen.done(), {});
    CHECK(text.find("\nARC,1,500,8000,0,0,-10,0,0,0,0,1,0,0,0,0,0,1,180\n") != std::string::npos);
    CHECK(text.find("\nG1,1,500,8000,0,0,-10,-9,0,0,0,1,,,,,,,\n") != std::string::npos);
    // Never "-0".
    CHECK(text.find("\nARC,1,500,8000,0,0,-10,-9,0,0,0,1,-5,-9,0,0,0,1,360\n") !=
          std::string::npos);
    CHECK(regression::format_golden(regression::parse_golden(text, "g").path, {}) == text);
}

TEST_CASE("a golden with the line ends of another system is the same", "[golden]") {
    const std::string text = head + "\n" + start + row;
    std::string other;
    for (const char c : text) other += c == '\n' ? std::string("\r\n") : std::string(1, c);
    CHECK(regression::format_golden(regression::parse_golden(other, "g").path, {}) ==
          regression::format_golden(regression::parse_golden(text, "g").path, {}));
    const auto read = regression::parse_golden(
        "# schema = trunnion.golden/1\n# reason = b\r\n# reason = a\n" + start + row, "g");
    CHECK(read.reasons == std::vector<std::string>{"b", "a"});
    CHECK(read.path.size() == 1);
    // Without an end of the last line too.
    CHECK(regression::parse_golden(head + start + row.substr(0, row.size() - 1), "g").path.size() ==
          1);
}

TEST_CASE("what is no golden is refused with its place", "[golden]") {
    CHECK(refusal(head + row).empty());
    CHECK(refusal("").find("1:1 not a golden") == 0);
    CHECK(refusal(row).find("1:1 not a golden") == 0);
    CHECK(refusal("# schema = trunnion.golden/2\n" + row).find("not a golden") !=
          std::string::npos);
    CHECK(refusal(head + "G5,1\n").find("3:1 not a motion") == 0);
    CHECK(refusal(head + "G1,1,500\n").find("a column is missing") != std::string::npos);
    for (const char* bad : {"x", "1x", "1e999", "nan", "inf", "+1", " 1"}) {
        INFO(bad);
        const std::string said =
            refusal(head + start + "G1,1," + bad + ",8000,0,0,1,2,3,0,0,1,,,,,,,\n");
        CHECK(said.find(std::string("4:6 not a number: '") + bad + "'") == 0);
    }
    // The distance to 1e308 overflows, and what is no number is no difference.
    for (const char* bad : {"1e308", "-1e308", "2e9"})
        CHECK(refusal(head + start + "G1,1,500,8000,0,0,1," + bad + ",3,0,0,1,,,,,,,\n") ==
              std::string("4:21 ") + bad + " is beyond 1e9");
    for (const char* bad : {"-1", "70000", "1.5"})
        CHECK(refusal(head + start + "G1," + bad + ",500,8000,0,0,1,2,3,0,0,1,,,,,,,\n") ==
              "4:4 a whole number of 0 to 65535 is expected here");
    CHECK(refusal(head + start + "G1,1,500,8000,0,256,1,2,3,0,0,1,,,,,,,\n") ==
          "4:17 a whole number of 0 to 255 is expected here");
}

TEST_CASE("a jump of the believed tip is kept, and a path without a move is a head alone",
          "[golden]") {
    Pen pen;
    pen.at(0, 0, 0).cut(1, 0, 0);
    pen.add(pen.segment(regression::SegmentKind::jump, 1, 0, 5)).cut(2, 0, 5);
    const std::string text = regression::format_golden(pen.done(), {});
    CHECK(text.find("\nJUMP,1,0,8000,0,0,1,0,5,") != std::string::npos);
    CHECK(regression::format_golden(regression::parse_golden(text, "g").path, {}) == text);
    const std::string empty = regression::format_golden(regression::PathRecord{}, {"none"});
    CHECK(empty.ends_with("sweep_deg\n"));
    CHECK(regression::parse_golden(empty, "g").path.size() == 0);
}

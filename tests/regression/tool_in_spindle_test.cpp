// What a belief hides: the tool in the spindle is not as long as the active offset says, an offset
// has no value in the setup, something stays in force behind the end.
#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "tests/regression/programs.h"

using namespace trunnion;
using namespace trunnion::testing;

namespace {

// T2 of the setup is 120 mm long, T1 150 mm; T5, H5 and H6 are in no store.
const std::string part =
    "%\nO1\nG90 G21 G17 G94 G54\nT2 M6\nS500 M3\nG0 X0. Y0.\nG43 H2 Z50.\nM8\nG1 Z-2. F200.\n"
    "G41 D2 X10.\nX50.\nG40 X60.\nG0 Z150.\nM9\nM5\nM30\n%\n";

std::string unknown_tool(std::string text) {
    return replaced(replaced(replaced(std::move(text), "T2", "T5"), "H2", "H5"), "D2", "D5");
}

/// The first line of the answer, empty where the programs are equal.
std::string answer(const std::string& a, const std::string& b) {
    static const setup::Setup setup = bc_table();
    const regression::Comparison r = compare_texts(a, b, setup);
    std::string all;
    for (const regression::Difference& d : r.differences) all += d.what + "; ";
    CHECK(r.equal == r.differences.empty());
    INFO(all);
    return all;
}

}  // namespace

TEST_CASE("a wrong length offset moves the tip of the tool that is in the spindle", "[compare]") {
    const setup::Setup setup = bc_table();
    const double h1_mm = setup.stores.tools.tool[1].length_mm(),
                 h2_mm = setup.stores.tools.tool[2].length_mm();
    REQUIRE(h1_mm != h2_mm);
    const auto moved = [](double by_mm) { return fmt::format("moved by Z{:+.4f} mm", by_mm); };
    using Catch::Contains;
    // The axes stand where they would with tool 1; the tip of tool 2 does not.
    CHECK_THAT(answer(part, replaced(part, "H2", "H1")), Contains(moved(h1_mm - h2_mm)));
    CHECK_THAT(answer(part, replaced(part, "G43 H2 ", "")),
               Contains("G43 is missing in B, G49 stays in force"));
    CHECK_THAT(answer(part, replaced(part, "G43", "G44")), Contains(moved(-2.0 * h2_mm)));
    CHECK_THAT(answer(part, replaced(part, "G43", "G10 L11 P2 R1.\nG43")), Contains(moved(1.0)));
}

TEST_CASE("five axes: a wrong length offset moves the tip", "[compare]") {
    const std::string a =
        "%\nO1\nG90 G21 G17 G94 G54\nT2 M6\nS500 M3\nG0 X0. Y0. B0. C0.\nG43.4 H2 Z50.\n"
        "G1 X10. B10. C20. F200.\nX20. B20. C40.\nX30. B30.\nG49\nM30\n%\n";
    CHECK(answer(a, a).empty());
    CHECK_THAT(answer(a, replaced(a, "H2", "H1")),
               Catch::Contains("H1 instead of H2: another path, up to 30.0000 mm"));
}

TEST_CASE("an offset without a value is not equal to another one", "[compare]") {
    const std::string a = unknown_tool(part);
    struct Row {
        const char *what, *with, *said;
    };
    const Row rows[] = {
        {"H5", "H6", "H6 (length not set) instead of H5 (length not set)"},
        {"G43 H5 ", "", "H5 (length not set) is missing in B"},
        {"D5", "D6", "G41 D6 (radius not set) instead of G41 D5 (radius not set)"},
        {"G41 D5", "G42 D5", "G42 D5 (radius not set) instead of G41 D5 (radius not set)"},
        {"G41 D5 ", "", "G41 D5 (radius not set) is missing in B"},
    };
    CHECK(answer(a, a).empty());
    for (const Row& row : rows) {
        INFO(row.what << " -> " << row.with);
        CHECK_THAT(answer(a, replaced(a, row.what, row.with)), Catch::Contains(row.said));
    }
    const std::string g55 = replaced(a, "G54", "G55");
    CHECK(answer(g55, g55).empty());
    CHECK_THAT(answer(g55, replaced(a, "G54", "G56")),
               Catch::Contains("G56 (not set) instead of G55 (not set)"));
    CHECK_THAT(answer(g55, replaced(a, "G54", "G54.1 P7")),
               Catch::Contains("G54.1 P7 (not set) instead of G55 (not set)"));
    // A value that both programs write by G10 is one.
    const std::string written = replaced(g55, "T5 M6", "T5 M6\nG10 L2 P2 X1.\nG10 L2 P3 X1.");
    CHECK(answer(written, replaced(written, "G55", "G56")).empty());
}

TEST_CASE("offsets that the setup states as 0 are set: the path decides", "[compare]") {
    setup::Setup setup = bc_table();
    for (const std::size_t k : {5, 6}) {
        setup.stores.tools.tool[k].length_given = true;
        setup.stores.tools.tool[k].radius_given = true;
    }
    const std::string a = unknown_tool(part);
    CHECK(compare_texts(a, replaced(a, "D5", "D6"), setup).equal);
    // The tool itself is still unknown: which H is right, nobody can tell.
    const regression::Comparison r = compare_texts(a, replaced(a, "H5", "H6"), setup);
    REQUIRE_FALSE(r.equal);
    CHECK(r.differences.front().what.find("not set") == std::string::npos);
}

TEST_CASE("what stays in force behind the end is a difference", "[compare]") {
    const auto ends = [](const char* with) { return answer(part, replaced(part, "M30", with)); };
    CHECK_THAT(ends("G92 X10.\nM30"), Catch::Contains("left active: G92 X"));
    CHECK_THAT(ends("G52 X10.\nM30"), Catch::Contains("left active: G52 X: 0 -> 10"));
    CHECK_THAT(ends("G68 X0. Y0. R30.\nM30"), Catch::Contains("left active: rotation G68 R"));
    CHECK_THAT(ends("G54.2 P1\nM30"), Catch::Contains("left active: G54.2 P: 0 -> 1"));
    CHECK_THAT(ends("#3003=1\nM30"), Catch::Contains("#3003"));
    CHECK(ends("G52 X10.\nG52 X0.\nM30").empty());
    // Codes that a reset may set again are told, but are no other machining.
    const setup::Setup setup = bc_table();
    const regression::Comparison r = compare_texts(part, replaced(part, "M30", "G91\nM30"), setup);
    CHECK(r.equal);
    REQUIRE_FALSE(r.notes.empty());
    CHECK(r.notes.back() == "at the end G90 is in force in A, G91 in B");
}

TEST_CASE("what the operator may not stop, and the level of G5.1, are compared", "[compare]") {
    CHECK_THAT(answer(part, replaced(part, "X50.", "#3003=1\nX50.\n#3003=0")),
               Catch::Contains("#3003=1 is only in B"));
    const std::string smooth = replaced(part, "X50.", "G5.1 Q1 R1\nX50.");
    CHECK(answer(smooth, smooth).empty());
    CHECK_THAT(answer(smooth, replaced(smooth, "R1", "R10")),
               Catch::Contains("G5.1 R10 instead of G5.1 R1"));
}

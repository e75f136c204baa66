// Programs that cannot run alone: --call and --devices on both sides, and what a report says that
// it did not compare.
#include <algorithm>
#include <catch2/catch.hpp>

#include "regression/left_aside.h"
#include "tests/regression/programs.h"

using namespace trunnion;
using namespace trunnion::testing;

namespace {

/// The line about what was not compared; empty: there is none.
std::string left_aside_of(const regression::Comparison& r) {
    std::string found;
    for (const std::string& note : r.notes)
        if (note.starts_with("not compared: ")) {
            CHECK(found.empty());  // one line
            found = note;
        }
    return found;
}

/// Touches the sphere S1 of the machine from above and moves over the place found.
std::string probing(double to_z_mm, double beside_mm) {
    return fmt::format(
        "O1\nG90 G21 G94 G54 G40 G49\nT1 M6\nG0 X120. Y0.\nG43 H1 Z120.\nG31 Z{:.1f} F50.\n"
        "#100=#5063\nG0 Z120.\nX{:.1f}\nG1 Z[#100+5.] F200.\nG0 Z120.\nM30\n",
        to_z_mm, 150.0 + beside_mm);
}

}  // namespace

TEST_CASE("with devices the probe answers: another target behind the same surface is equal",
          "[compare]") {
    const setup::Setup setup = bc_table();
    const std::string a = probing(80.0, 0.0), b = probing(70.0, 0.0);
    const regression::Comparison blind = compare_texts(a, b, setup);
    INFO(blind.verdict);
    CHECK_FALSE(blind.equal);  // G31 ran to its end, 10 mm deeper
    CHECK(blind.position_mm == Approx(10.0));
    CHECK(left_aside_of(blind).find("what a probe would answer") != std::string::npos);
    regression::CompareOptions devices;
    devices.devices = true;
    const regression::Comparison touched = compare_texts(a, b, setup, devices);
    INFO(touched.verdict);
    CHECK(touched.equal);
    CHECK(left_aside_of(touched).empty());
    // With the devices a program may dwell and print as well.
    const auto prints = [](std::string text) {
        return replaced(std::move(text), "#100=#5063",
                        "G4 X1.\n#100=#5063\nPOPEN\nDPRNT[#100[34]]\nPCLOS");
    };
    CHECK(compare_texts(prints(a), prints(b), setup, devices).equal);
    CHECK_FALSE(
        compare_texts(prints(a), replaced(prints(b), "DPRNT[", "DPRNT[Z"), setup, devices).equal);
    // And a difference of the machining behind the touch is found.
    const regression::Comparison moved = compare_texts(a, probing(70.0, 0.5), setup, devices);
    INFO(moved.verdict);
    CHECK_FALSE(moved.equal);
    CHECK(moved.differences.front().a.block.starts_with("X150."));
}

TEST_CASE(
    "The option --call gives both sides the same arguments: equal for some, different for others",
    "[compare]") {
    const setup::Setup setup = bc_table();
    const auto macro = [](const char* depth) {
        return fmt::format(
            "O9100\nIF[#7EQ#0]THEN #3000=1(D MISSING)\nG90 G94 G54\nS500 M3\nG0 X0. Y0. Z200.\n"
            "G1 X#7 F300.\nZ[{}]\nG0 Z200.\nM99\n",
            depth);
    };
    const std::string a = macro("200.-#7"), b = macro("200.-ABS[#7]");
    regression::CompareOptions call;
    call.call = "G65 P9100 D12.";
    const regression::Comparison equal = compare_texts(a, b, setup, call);
    INFO(equal.verdict);
    CHECK(equal.equal);
    CHECK(equal.compared > 2);
    CHECK(left_aside_of(equal).find("branches that were not taken") != std::string::npos);
    call.call = "G65 P9100 D-12.";
    const regression::Comparison other = compare_texts(a, b, setup, call);
    INFO(other.verdict);
    CHECK_FALSE(other.equal);
    CHECK(other.position_mm == Approx(24.0));
    CHECK(other.differences.front().a.line == line_with(a, "Z[200.-#7]"));
}

TEST_CASE("both sides begin with the variables of the setup", "[compare]") {
    setup::Setup setup = bc_table();
    setup.stores.variables[500] = 9.0;
    const std::string a = "O1\nG90 G21 G94 G54\nS500 M3\nG0 X0. Y0. Z200.\nG1 X#500 F300.\nM30\n";
    CHECK(compare_texts(a, replaced(a, "X#500", "X9."), setup).equal);
    CHECK_FALSE(compare_texts(a, replaced(a, "X#500", "X8."), setup).equal);
}

TEST_CASE("what was not compared is said in one line, and only what there was", "[compare]") {
    const setup::Setup setup = bc_table();
    const std::string a = "O1\nG90 G21 G94 G54\nS500 M3\nG0 X0. Y0. Z200.\nG1 X9. F300.\nM30\n";
    const auto left = [&](const std::string& p) {
        return left_aside_of(compare_texts(p, replaced(p, "G1 X9.", "G1 X8."), setup));
    };
    CHECK(left(a).empty());
    CHECK(left(replaced(a, "S500 M3", "(IF / WHILE)S500 M3")).empty());
    CHECK(left(replaced(a, "S500", "/ S500")) ==
          "not compared: blocks behind '/' with other switches");
    CHECK(left(replaced(a, "S500", "N5 /2 S500")) ==
          "not compared: blocks behind '/' with other switches");
    CHECK(left(replaced(a, "S500", "IF[#1EQ2]GOTO9\nN9 S500")) ==
          "not compared: branches that were not taken");
    // In one of the programs alone, whichever it is.
    const std::string branch = replaced(a, "S500", "IF[#1EQ2]GOTO9\nN9 S500");
    for (const auto& [first, second] : {std::pair{a, branch}, {branch, a}})
        CHECK(left_aside_of(compare_texts(first, second, setup)) ==
              "not compared: branches that were not taken");
    const regression::Comparison stopped =
        compare_texts(a, replaced(a, "X9. F300.", "X9. F300.\n#3000=7(OFF)"), setup);
    CHECK(left_aside_of(stopped).ends_with("what follows an alarm"));
    CHECK(compare_texts(a, a, setup).notes.empty());
}

TEST_CASE("ways that a text leaves open, up to its last character", "[compare]") {
    using regression::open_ways;
    for (const char* text : {"IF[#1EQ2]GOTO3", "goto 5", "X1.\nWHILE[#1LT2]DO1", "GO"}) {
        INFO(text);
        CHECK(open_ways(text).branches);
    }
    for (const char* text : {"", "X1. I", "G", "W", "(IF)", "(A)(GOTO", "I F"}) {
        INFO(text);
        CHECK_FALSE(open_ways(text).branches);
    }
    CHECK(open_ways("X1.\n/2 X2.").skips);
    CHECK(open_ways("N5 / X2.").skips);
    CHECK_FALSE(open_ways("X[1/2]\n(/)\nG1 /X2.").skips);
}

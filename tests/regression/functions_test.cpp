// What a program does besides moving: M codes, dwells, modes, stores, variables and prints.
#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "tests/regression/programs.h"

using namespace trunnion;
using namespace trunnion::testing;

namespace {

const std::string part =
    "%\nO1\nG90 G21 G17 G94 G54\nT1 M6\nS500 M3\nG43 H1 Z150.\nG0 X0. Y0.\nM8\nG1 Z140. F200.\n"
    "X50.\nG4 X2.\nX60.\nG0 Z150.\nM9\nM5\nM30\n%\n";

/// Every difference of a layer with the lines where it is shown.
std::string said(const std::string& a, const std::string& b, regression::Layer layer,
                 std::size_t most = 1000) {
    static const setup::Setup setup = bc_table();
    regression::CompareOptions options = only(layer);
    options.most_differences = most;
    const regression::Comparison r = compare_texts(a, b, setup, options);
    std::string all;
    for (const regression::Difference& d : r.differences)
        all += fmt::format("{} x{} @{},{}\n", d.what, d.count, d.a.line, d.b.line);
    if (r.differences_left_out > 0) all += fmt::format("left out {}\n", r.differences_left_out);
    CHECK(r.equal == r.differences.empty());
    return all;
}

std::string functions(const std::string& a, const std::string& b) {
    return said(a, b, regression::Layer::functions);
}

}  // namespace

TEST_CASE("a G10 is another one where it writes another store, whatever values it writes",
          "[compare]") {
    const auto pair = [](const char* store, double first_mm) {
        // Both stores are 0 at the end.
        return replaced(part, "X60.",
                        fmt::format("G10 L2 {0} X{1}\nG10 L2 {0} X0.\nX60.", store,
                                    fmt::format("{:.1f}", first_mm)));
    };
    for (const char* store : {"P2", "P3", "P5"})
        for (const char* other : {"P2", "P3", "P5"})
            for (const double other_mm : {1.0, 2.0}) {
                INFO(store << " " << other << " " << other_mm);
                CHECK(functions(pair(store, 1.0), pair(other, other_mm)).empty() ==
                      (std::string(store) == other));
            }
}

// A function that one side has is shown on the other at the next one there; coolant is a sequence
// of its own.
TEST_CASE("each function has its name and place", "[compare]") {
    struct Row {
        const char *what, *with, *said;
    };
    const Row row = GENERATE(values<Row>({
        {"S500 M3", "S500 M4", "M4 instead of M3 x1 @5,5\n"},
        {"M8", "M7", "M7 instead of M8 x1 @8,8\n"},
        {"M8", "M8\nM7", "M7 M8 instead of M8 x1 @8,9\n"},
        {"M8", "M8\nM8", ""},
        {"M8\n", "", "M8 is missing in B x1 @8,13\n"},
        {"X60.", "M0\nX60.", "M0 is only in B x1 @15,12\n"},
        {"G4 X2.", "G4 X2.5", "dwell 2 s -> 2.5 s x1 @11,11\n"},
        {"G4 X2.\n", "", "dwell 2 s is missing in B x1 @11,14\n"},
        {"T1 M6", "T2 M6", "T2 M6 instead of T1 M6 x1 @4,4\n"},
        {"X50.", "G61 X50.\nG64", "exact stop (G9, G61) is only in B x1 @11,10\n"},
        {"G1 Z140.", "G5.1 Q1\nG1 Z140.", "G5.1 Q1 is only in B x1 @11,9\n"},
        {"X60.", "G10 L2 P3 X1.\nX60.", "G10 that writes a store is only in B x1 @15,12\n"},
        {"X60.", "G63 X60.\nG64", "G63 is only in B x1 @15,12\nG64 is only in B x1 @15,13\n"},
    }));
    INFO(row.what << " became " << row.with);
    const std::string found = functions(part, replaced(part, row.what, row.with));
    CHECK(found == row.said);
}

TEST_CASE("the same change in many places is one difference, and a limit counts the others",
          "[compare]") {
    std::string a = part, b = part;
    for (int k = 0; k < 5; ++k) {
        const std::string cut = fmt::format("G1 X{}.\nG4 X1.\nG0 X0.\n", 50 + k);
        a = replaced(a, "M9\n", cut + "M9\n");
        b = replaced(b, "M9\n", replaced(cut, "G4 X1.", "G4 X3.") + "M9\n");
    }
    CHECK(functions(a, b).find("dwell 1 s -> 3 s x5 @") == 0);
    const std::string other =
        replaced(replaced(replaced(b, "M8\n", "M7\n"), "M5\n", "M19\n"), "S500 M3", "S500 M4");
    const std::string first = said(a, other, regression::Layer::functions, 1);
    CHECK(first.find("M4 instead of M3 x1") == 0);
    CHECK(first.find("left out ") != std::string::npos);
}

TEST_CASE("a function before another cut stands at another place", "[compare]") {
    static const setup::Setup setup = bc_table();
    const std::string b = replaced(replaced(part, "M8\n", ""), "X50.\n", "X50.\nM8\n");
    const regression::Comparison r = compare_texts(part, b, setup);
    INFO(r.verdict);
    CHECK_FALSE(r.equal);
    // So does a spindle that stops before a cut: its order is the same, the cut is another.
    const std::string stopped = replaced(part, "X60.", "M5\nX60.");
    CHECK(functions(part, stopped).empty());
    const regression::Comparison cut = compare_texts(part, stopped, setup);
    CHECK_FALSE(cut.equal);
    CHECK(cut.differences.front().what.find("spindle 500 -> 0 rpm") != std::string::npos);
    // Without a cut between the two places it is the same.
    const std::string same = replaced(replaced(part, "M8\n", ""), "G1 Z140.", "M8\nG1 Z140.");
    CHECK(compare_texts(part, same, setup).equal);
}

TEST_CASE("a side without any function is compared with one that has some", "[compare]") {
    const std::string none = "O1\nG90 G21 G94 G54\nG0 X0. Y0. Z200.\nG1 X9. F300.\n";
    const std::string some = replaced(none, "G1", "M8\nG1");
    CHECK(functions(none, none).empty());
    CHECK(functions(none, some).find("M8 is only in B x1 @0,4\n") == 0);
    CHECK(functions(some, none).find("M8 is missing in B x1 @4,0\n") == 0);
}

TEST_CASE("variables that a program leaves behind: vacant is not 0", "[compare]") {
    const auto effects = [](const char* a, const char* b) {
        return said(replaced(part, "M30", std::string(a) + "\nM30"),
                    replaced(part, "M30", std::string(b) + "\nM30"), regression::Layer::effects);
    };
    CHECK(effects("#500=1.", "#500=1.").empty());
    CHECK(effects("#500=#0", "#500=#0").empty());
    CHECK(effects("#500=1.", "#500=1.0001").empty());
    CHECK(effects("#500=1.", "#500=2.") == "#500: 1 -> 2 x1 @0,0\n");
    CHECK(effects("#500=1.", "#500=#0") == "#500: 1 -> vacant x1 @0,0\n");
    CHECK(effects("#500=#0", "#500=0") == "#500: vacant -> 0 x1 @0,0\n");
    CHECK(effects("#500=1.", "") == "#500: 1 -> vacant x1 @0,0\n");
    CHECK(effects("", "#501=7.") == "#501: vacant -> 7 x1 @0,0\n");
    CHECK(effects("G10 L2 P3 X5.", "") == "G56 X: 5 -> 0 x1 @0,0\n");
}

TEST_CASE("lines that are printed are compared one by one until one side has no more",
          "[compare]") {
    const auto printed = [](const char* a, const char* b) {
        const auto program = [](const char* lines) {
            return replaced(part, "M30", std::string("POPEN\n") + lines + "PCLOS\nM30");
        };
        return said(program(a), program(b), regression::Layer::effects);
    };
    CHECK(printed("DPRNT[A]\nDPRNT[B]\n", "DPRNT[A]\nDPRNT[B]\n").empty());
    CHECK(printed("DPRNT[A]\nDPRNT[B]\n", "DPRNT[A]\nDPRNT[C]\n") ==
          "printed line 2: 'B' -> 'C' x1 @0,0\n");
    CHECK(printed("DPRNT[A]\nDPRNT[B]\n", "DPRNT[A]\n") ==
          "printed line 2: 'B' -> nothing x1 @0,0\n");
    CHECK(printed("", "DPRNT[A]\nDPRNT[B]\n") == "printed line 1: nothing -> 'A' x1 @0,0\n");
    // And they belong to the machining: the default finds them.
    static const setup::Setup setup = bc_table();
    const std::string a = replaced(part, "M30", "POPEN\nDPRNT[A]\nPCLOS\nM30");
    CHECK_FALSE(compare_texts(a, replaced(a, "DPRNT[A]", "DPRNT[B]"), setup).equal);
}

TEST_CASE("spindle, coolant and tool of a cut are said with both values", "[compare]") {
    const auto path = [](const char* what, const char* with) {
        return said(part, replaced(part, what, with), regression::Layer::path);
    };
    CHECK(path("S500 M3", "S600 M3").find("S600 instead of S500: spindle 500 -> 600 rpm (T1)") ==
          0);
    CHECK(path("M8\n", "").find("coolant on -> off (T1)") != std::string::npos);
    CHECK(said(replaced(part, "M8\n", ""), part, regression::Layer::path)
              .find("coolant off -> on (T1)") != std::string::npos);
    CHECK(path("T1 M6", "T2 M6").find("T2 instead of T1") == 0);
    CHECK(path("F200.", "F300.").find("feed 200 -> 300 mm/min (T1)") != std::string::npos);
}

TEST_CASE("an exact stop that ends earlier is said on the side that says so", "[compare]") {
    const std::string on = replaced(part, "G1 Z140.", "G61 G1 Z140.");
    const std::string off = replaced(on, "X60.", "G64 X60.");
    CHECK(functions(on, off) == "end of exact stop (G64) is only in B x1 @15,12\n");
    CHECK(functions(off, on) == "end of exact stop (G64) is missing in B x1 @12,15\n");
    // What one side begins and ends is one difference.
    const std::string again =
        replaced(off, "G0 Z150.\n", "G0 Z150.\nG61\nG1 X50. F300.\nG64\nX60.\n");
    const std::string found = functions(off, again);
    CHECK(found.find("exact stop (G9, G61) is only in B x1") == 0);
    CHECK(found.find("end of exact stop") == std::string::npos);
}

TEST_CASE("a full circle and a block that stands still", "[compare]") {
    static const setup::Setup setup = bc_table();
    const std::string circle = replaced(part, "X60.\n", "G3 I-5.\nG1 X60.\n");
    CHECK(compare_texts(circle, replaced(circle, "I-5.", "I-5.0 J0."), setup).equal);
    CHECK_FALSE(compare_texts(circle, part, setup).equal);
    CHECK_FALSE(compare_texts(circle, replaced(circle, "I-5.", "I-5.1"), setup).equal);
    CHECK(compare_texts(part, replaced(part, "X60.\n", "G91 X0.\nG90 X50.\nX60.\n"), setup).equal);
}

TEST_CASE("functions that change one behind the other are told in pairs, each at its place",
          "[compare]") {
    const std::string a = "O1\nG90 G54\nM10\nM11\nG0 X1.\nM98 P2\nM30\nO2\nM12\nM99\n";
    const std::string b = replaced(replaced(a, "M10", "M20"), "M11", "M21");
    CHECK(functions(a, b) == "M20 instead of M10 x1 @3,3\nM21 instead of M11 x1 @4,4\n");
    CHECK(functions(a, replaced(a, "M12", "M22")) == "M22 instead of M12 x1 @9,9\n");
}

// The layer `words`: which changes of the text it passes over, and which it does not.
#include <catch2/catch.hpp>

#include "interpreter/dialect.h"
#include "regression/program_lines.h"

using namespace trunnion;

namespace {

bool same(const std::string& a, const std::string& b, bool codes_call = false) {
    const interpreter::Dialect dialect = interpreter::fanuc_dialect();
    std::uint64_t compared = 0;
    const auto keys_a = regression::word_keys(a, dialect, codes_call),
               keys_b = regression::word_keys(b, dialect, codes_call);
    return regression::same_keys(*keys_a, *keys_b, compared);
}

struct Row {
    const char *a, *b;
    bool same;
};

}  // namespace

TEST_CASE("computed blocks are compared as written, without blanks, case and comments",
          "[compare]") {
    const Row row = GENERATE(values<Row>({
        {"X[#1]\n", "n10 x [ #1 ] (over)\n", true},
        {"X[#1]\n", "X[#2]\n", false},
        {"X[#1]", "X[#1]\r\n", true},
        {"N10 #1=2.\n", "N20 #1=2.\n", true},
        {"N10 #1=2.\nM99 P10\n", "N20 #1=2.\nM99 P10\n", false},  // a target
        {"#1=2.\n", "(A) #1=2.\n(B)\n", true},
        {"N10\n", "\n", true},
        {"NABC#1\n", "NABD#1\n", false},
        {"DPRNT[A B]\n", "DPRNT[A  B]\n", false},
        {"DPRNT[A B]\r\n", "DPRNT[A B]\n", true},
        {"DPRNT[a]\n", "DPRNT[A]\n", false},
        {"M98 <ONE>\n", "M98 <TWO>\n", false},
        {"G1 X1. ?\n", "G1 X1. ?? \n", false},
        {"G1 X1. ?\n", "g1x1.?\n", false},  // it stops the program: as written
        {"X1.\nN10 (OPEN\n", "X1.\n", false},
        {"X1.\n(OPEN\n", "X1.\n", false},
        {"X1. (\n", "X1.\n", false},
    }));
    INFO(row.a << " | " << row.b);
    CHECK(same(row.a, row.b) == row.same);
}

TEST_CASE("N numbers count where the program jumps, and between G10 and G11", "[compare]") {
    const Row row = GENERATE(values<Row>({
        {"N1 G1 X1.\nN2\n", "G1 X1.\n", true},
        {"N1 G1 X1.\nGOTO 1\n", "N2 G1 X1.\nGOTO 1\n", false},
        {"N1\nGOTO 1\n", "N2\nGOTO 1\n", false},
        {"N1 G1 X1.\nWHILE[#1LT2]DO1\nEND1\n", "N2 G1 X1.\nWHILE[#1LT2]DO1\nEND1\n", false},
        {"G10 L50\nN1320 P1 R5.\nG11\n", "G10 L50\nN1321 P1 R5.\nG11\n", false},
        {"G10 L50\nN0 R5.\nG11\n", "G10 L50\nR5.\nG11\n", false},  // parameter 0
        {"G10 L3\nN1 R5.\nG11\n", "G10 L3\nN2 R5.\nG11\n", false},
        {"G10 L50\nG11\nN5 X1.\n", "G10 L50\nG11\nN6 X1.\n", true},
        {"G10 L2 P1 X1.\nN5 X1.\n", "G10 L2 P1 X1.\nN6 X1.\n", true},
        {"G10 L20 P1 X1.\nN5 X1.\n", "G10 L20 P1 X1.\nN6 X1.\n", true},
        {"G10 L11 P1 R1.\nN5 X1.\n", "G10 L11 P1 R1.\nN6 X1.\n", true},
        {"G10 L14 P1 R1.\nN5 X1.\n", "G10 L14 P1 R1.\nN6 X1.\n", false},  // in doubt
        {"G10 P1 R1.\nN5 X1.\n", "G10 P1 R1.\nN6 X1.\n", false},
    }));
    INFO(row.a << " | " << row.b);
    CHECK(same(row.a, row.b) == row.same);
}

TEST_CASE("a word that repeats what is in force changes nothing, unless something lies between",
          "[compare]") {
    const std::string head = "G90 G94 G40 G1 X1. Y1. F100.\n";
    const Row row = GENERATE(values<Row>({
        {"X2. Y1.\n", "X2.\n", true},
        {"X2. F100.\n", "X2.\n", true},
        {"S500 M3\nS500 X2.\n", "S500 M3\nX2.\n", true},
        {"G95 F0.1\nX2. F0.1\n", "G95 F0.1\nX2.\n", true},
        {"G93 F2.\nX2. F2.\n", "G93 F2.\nX2.\n", false},  // F is asked for in each block
        {"G96 S100\nS100 X2.\n", "G96 S100\nX2.\n", false},
        {"G91 X2. Y1.\n", "G91 X2.\n", false},
        {"G41 D1 X2. Y1.\n", "G41 D1 X2.\n", false},
        {"G2 X2. Y1. R3.\n", "G2 X2. R3.\n", false},
        {"G81 X2. Y1. Z0. R1.\n", "G81 X2. Z0. R1.\n", false},
        {"M98 P5\nX1. Y2.\n", "M98 P5\nY2.\n", false},
        {"M198 P5\nX1. Y2.\n", "M198 P5\nY2.\n", false},
        {"M99 P5\nX2. F100.\n", "M99 P5\nX2.\n", false},
        {"M198 P5\nX2. F100.\n", "M198 P5\nX2.\n", false},
        {"G65 P5\nX1. Y2.\n", "G65 P5\nY2.\n", false},
        {"G66 P5\nX1. Y2.\n", "G66 P5\nY2.\n", false},
        {"#100=1\nX1. Y2.\n", "#100=1\nY2.\n", false},
        {"/X5.\nX1. Y2.\n", "/X5.\nY2.\n", false},
        {"M8\nX1. Y2.\n", "M8\nY2.\n", true},
        {"M6\nX1. Y2.\n", "M6\nY2.\n", false},
        {"M10\nX1. Y2.\n", "M10\nY2.\n", false},  // the builder's: it may move axes
        {"G54\nX1. Y2.\n", "G54\nY2.\n", false},
        {"G68.2 X0 Y0 Z0 I0 J30 K0\nG94 X2.\n", "G68.2 X0 Y0 Z0 I0 J30 K0\nX2.\n", false},
        {"G68.3 X0 Y0 Z0\nG94 X2.\n", "G68.3 X0 Y0 Z0\nX2.\n", false},
        {"G68.4 X0 Y0 Z0 I0 J30 K0\nG94 X2.\n", "G68.4 X0 Y0 Z0 I0 J30 K0\nX2.\n", false},
        {"X3. X2.\n", "X2. X3.\n", false},  // the last one counts
        {"G0 G1 X3.\n", "G1 G0 X3.\n", false},
        {"M3 M8 X2.\n", "M8 M3 X2.\n", false},  // in the order written
        {"Y3. X2. ,R1.\n", "X2. Y3. ,R1.\n", true},
        {"X2. ,R1.\n", "X2. ,R2.\n", false},
        {"G16\nX1. Y20.\n", "G16\nY20.\n", false},
    }));
    INFO(row.a << " | " << row.b);
    CHECK(same(head + row.a, head + row.b) == row.same);
}

TEST_CASE("where codes call programs nothing counts as repeated", "[compare]") {
    CHECK(same("G90 G1 X1. F100.\nY2. X1.\n", "G90 G1 X1. F100.\nY2.\n", false));
    CHECK_FALSE(same("G90 G1 X1. F100.\nY2. X1.\n", "G90 G1 X1. F100.\nY2.\n", true));
}

TEST_CASE("the layer text passes over line ends, blanks behind and empty lines at the end",
          "[compare]") {
    const auto alike = [](const std::string& a, const std::string& b) {
        std::uint64_t compared = 0;
        const auto keys_a = regression::text_keys(a), keys_b = regression::text_keys(b);
        return regression::same_keys(*keys_a, *keys_b, compared);
    };
    CHECK(alike("X1.\nX2.", "X1. \t\r\nX2.\r\n \n\n"));
    CHECK(alike("", "\n \n"));
    CHECK_FALSE(alike("X1.\n", "X1.\nX2.\n"));
    CHECK_FALSE(alike("X1.\nX2.\n", "X1.\n"));
    CHECK_FALSE(alike("X1.\n", " X1.\n"));
}

TEST_CASE("lines of a program by number, however long it is", "[compare]") {
    std::string text;
    for (int n = 1; n <= 600; ++n) text += "X" + std::to_string(n) + ". \r\n";
    text += "A\tB\x01";
    const regression::ProgramLines lines(text);
    CHECK(lines.count() == 601);
    CHECK(lines.line(1) == "X1.");
    CHECK(lines.line(256) == "X256.");
    CHECK(lines.line(257) == "X257.");
    CHECK(lines.line(600) == "X600.");
    CHECK(lines.line(601) == "A\tB?");
    CHECK(lines.line(0).empty());
    CHECK(lines.line(602).empty());
    CHECK(regression::ProgramLines("").line(1).empty());
}

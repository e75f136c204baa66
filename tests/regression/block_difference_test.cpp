#include "regression/block_difference.h"

#include <catch2/catch.hpp>

using namespace trunnion;

namespace {

std::string words(const std::string& a, const std::string& b) {
    return regression::block_difference(a, b, {}).words;
}

}  // namespace

TEST_CASE("what stands in a comment is no word of a block") {
    CHECK(words("G1 X45. (X1 Y2)", "G1 X54.").find("X54. instead of X45.") == 0);
    CHECK(words("G1 X45. (X1 Y2)", "G1 X45. (X9)").empty());
    CHECK(words("(T3 FACE) G1 X45.", "(T4 BORE) G1 X54.").find("X54. instead of X45.") == 0);
    CHECK(words("G1 X45. Y1.", "G1 X45. Y1.").empty());
}

TEST_CASE("a change of values that has a name is called by it") {
    struct Row {
        const char *a, *b, *said;
    };
    const Row row = GENERATE(values<Row>({
        {"X100. Y5.", "X100 Y5.", "decimal point lost: X100 instead of X100."},
        {"X100", "X100.", "decimal point added: X100. instead of X100"},
        {"X1. Y-2.", "X-1. Y2.", "X Y of opposite sign: X-1. Y2. instead of X1. Y-2."},
        {"X1. Y2.", "X2. Y1.", "X and Y exchanged: X2. Y1. instead of X1. Y2."},
        {"X1. Y2.", "X2. Y3.", "X2. Y3. instead of X1. Y2."},
        {"X1. Y2.", "X3. Y1.", "X3. Y1. instead of X1. Y2."},
        {"X25.4", "X1.", "inch instead of mm: X1. instead of X25.4"},
        {"X1.", "X25.4", "mm instead of inch: X25.4 instead of X1."},
        {"X1. Y1.", "X25.4 Y9.", "X25.4 Y9. instead of X1. Y1."},
        {"F100", "F100.", ""},  // a feed means the same with and without
        {"X0", "X0.", ""},      // and so does nothing
        {"X1.", "X1. Y2.", "Y2. is only in B"},
        {"X1. Y2.", "X1.", "Y2. is missing in B"},
        {"X1. Y2. Z3.", "X5. Y7. Z9.", "X5. Y7. Z9. instead of X1. Y2. Z3."},
        {"X1. Y2. Z3. A4.", "X5. Y6. Z7. A8.", ""},  // too much to be said
        {"X1.", "Y2.", "Y2. instead of X1."},
        {"/G1 X1.", "/G1 X2.", "X2. instead of X1."},
        {"n10 g1 x1.", "N20 G1 X2.", "X2. instead of X1."},
    }));
    INFO(row.a << " | " << row.b);
    CHECK(text_of(regression::block_difference(row.a, row.b, {})) == row.said);
}

TEST_CASE("computed values are compared as written, and get no name") {
    CHECK(words("X#100", "X#101") == "X#101 instead of X#100");
    CHECK(words("X1.", "X#101") == "X#101 instead of X1.");
    CHECK(words("X#101", "X1.") == "X1. instead of X#101");
    CHECK(words("X[#1+Y]", "X[#1+Y]").empty());
    CHECK(words("X[-[#1]]", "X[[#1]]") == "X[[#1]] instead of X[-[#1]]");
    // Other statements have no words.
    CHECK(words("IF[#1EQ2]GOTO3", "IF[#1EQ2]GOTO4").empty());
    CHECK(words("G65 P1 A2.", "#1=3.") == "G65 P1 A2. is missing in B");
}

TEST_CASE("an assignment is said as a whole") {
    CHECK(words("#1=2.", "#1=3.") == "#1=3. instead of #1=2.");
    CHECK(words("N10 #1 = 2.\r", "N20 #1=3.") == "#1=3. instead of #1=2.");
    CHECK(words("N10 #1=2.", "N20 # 1 = 2.").empty());
    CHECK(words("N10", "N20").empty());
    const std::string longest(37, '9');
    CHECK(words("#1=2.", "#1=" + longest) == "#1=" + longest + " instead of #1=2.");
    CHECK(words("#1=2.", "#1=" + longest + "9").empty());
}

TEST_CASE("centres of arcs that are absolute on one side are called so where the start is known") {
    const std::array<std::optional<double>, 3> start{10.0, -4.0, std::nullopt};
    const auto said = [&](const char* a, const char* b) {
        return regression::block_difference(a, b, start).name;
    };
    CHECK(said("G2 X1. I5. J3.", "G2 X1. I15. J-1.") == "I J absolute instead of incremental");
    CHECK(said("G2 X1. I15. J-1.", "G2 X1. I5. J3.") == "I J incremental instead of absolute");
    CHECK(said("G2 I5. J3.", "G2 I15. J3.5").empty());
    CHECK(said("G2 I5. K3.", "G2 I15. K9.").empty());  // Z of the start is not known
    CHECK(said("G2 I5. R3.", "G2 I15. R9.").empty());  // no centre
    CHECK(said("G2 I5. A3.", "G2 I15. A9.").empty());
}

TEST_CASE("the positions that a block writes as numbers") {
    const auto found = regression::position_words("G1 X1. Y#2 A3. (Z9.)");
    CHECK(found[0] == 1.0);
    CHECK_FALSE(found[1]);
    CHECK_FALSE(found[2]);
}

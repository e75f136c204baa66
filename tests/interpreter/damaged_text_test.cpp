// A text that a transfer cut off or garbled: it ends, or in an alarm at a place inside the text.
#include <algorithm>
#include <catch2/catch.hpp>

#include "interpreter/print.h"
#include "support.h"
#include "tests/support/printed_program.h"

using namespace trunnion;
using namespace trunnion::test;

namespace {

/// One of each construct of the language.
const std::string every_construct =
    "\xEF\xBB\xBF%\nO0001(MAIN)\n&F=/USER/\n/2N10G1X+1.5(c),R2.F#101/M8\n"
    "#1=ATAN[1]/[2]+PRM[1,2]/[3]-ROUND[#[100+1]]MOD3\nSETVN500[LEN,R_2]\n#[#LEN]=-POW[2,.5]\n"
    "IF[[#1EQ#0]OR[#2GE3]]GOTO20\nIF[#1LT2]THEN#3=4\nWHILE[#4LT2]DO1\n#4=#4+1\nDO2\nGOTO15\n"
    "END2\nN15END1\nPOPEN\nDPRNT[A*#1[44]]\nBPRNT[#1[2]]\nPCLOS\nN20M98P9L2Q5\nG65P9A1.I2.\n"
    "G66.1<SUB-1>\nX1.\nG67\nM99P30\nN30M30\nO9\nN5X1.\nM99\n<SUB-1>\nM99\n%\n";

int lines_of(const std::string& text) {
    return 2 + static_cast<int>(std::count(text.begin(), text.end(), '\n'));
}

void check_run(const std::string& text, const interpreter::InterpreterOptions& options) {
    INFO(text);
    const Run r = run(text, options);
    if (!r.alarm) return;
    REQUIRE(interpreter::language_alarm(r.alarm->number));
    REQUIRE(r.alarm->where.program == "main.nc");
    REQUIRE(r.alarm->where.line >= 1);
    REQUIRE(r.alarm->where.line <= lines_of(text));
    REQUIRE(r.alarm->where.column >= 1);
}

}  // namespace

TEST_CASE("a program that is cut off at any byte ends, or alarms inside what is left") {
    interpreter::InterpreterOptions options;
    options.max_blocks = 60;
    for (const bool hurco : {false, true}) {
        if (hurco) options.dialect = interpreter::hurco_dialect();
        const std::string text = every_construct + (hurco ? "E \n" : "");
        for (std::size_t size = 0; size <= text.size(); ++size) {
            check_run(text.substr(0, size), options);
            check_print(text.substr(0, size), options.dialect);
        }
    }
}

TEST_CASE("a program with one character too many ends, or alarms inside the text") {
    interpreter::InterpreterOptions options;
    options.max_blocks = 60;
    const std::string strays = std::string("%;/O:<>#,N5.+-[]*=()&E@a\n\r\x1A\x7f") + '\0';
    for (std::size_t at = 0; at <= every_construct.size(); ++at)
        for (const char c : strays) {
            std::string text = every_construct;
            text.insert(at, 1, c);
            check_run(text, options);
            check_print(text, options.dialect);
        }
}

TEST_CASE("lines that end in the middle of what a search looks for") {
    // The loop's end is searched over these lines, which are no DO and no END.
    for (const std::string between :
         {"N5", "(open", "(open\n", "/", "/2", "WHILE[1EQ1]", "WHILE[1EQ1]D", "WHILE[1EQ1]DX",
          "WHILE[1EQ1]DO", "DO", "DO9", "DO0", "X1.", "#2=1", "N99999999999", "O", "5",
          "IF[1EQ2]GOTO1"}) {
        INFO(between);
        CHECK(alarm_of("#1=0\nWHILE[#1EQ0]DO1\n" + between) == 124);
        CHECK_FALSE(run("WHILE[#1EQ1]DO1\n" + between + "\nEND1\n").alarm);
    }
    CHECK(alarm_of("WHILE[#1EQ1]DO1\nEND\n") == 124);
    CHECK(alarm_of("WHILE[#1EQ1]DO1\nO5\nEND1\n") == 124);
    CHECK(run("WHILE[#1EQ1]DO1\nW[1EQ1]\nWH[1EQ1]DO2\nEND2\nEND1\nX1.\n").blocks == Blocks{"X1"});
}

TEST_CASE("an old end-of-file mark ends the text, with blanks before it as well") {
    for (const std::string end : {"\x1A", " \x1A", "%\n\x1A",
                                  "M99\x1A"
                                  "X5.\n"})
        CHECK(run("X1.\n" + end + "X2.\n").blocks.front() == "X1");
    const interpreter::ParsedProgram p =
        interpreter::parse_program({"p", "X1.\n \x1A\nX2.\n", nullptr}, {});
    CHECK(p.blocks.size() == 1);
    CHECK(run("\x1A").blocks.empty());
}

#include "interpreter/lexical.h"

#include <catch2/catch.hpp>
#include <cstdlib>

#include "support.h"

using namespace trunnion;
using namespace trunnion::test;

TEST_CASE("numbers are read exactly as the library reads them") {
    std::uint64_t seed = 12345;
    for (int i = 0; i < 20000; ++i) {
        seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
        const auto digits = static_cast<int>(1 + (seed >> 33) % 15);
        std::string text = std::to_string(seed).substr(0, static_cast<std::size_t>(digits));
        if (seed & 4) text.insert((seed >> 40) % (text.size() + 1), ".");
        const char* p = text.data();
        const interpreter::Number n = interpreter::read_number(p, text.data() + text.size());
        REQUIRE(p == text.data() + text.size());
        REQUIRE(n.value == std::strtod(text.c_str(), nullptr));
    }
}

TEST_CASE("words without blanks, in any order, lower case, signs and blanks anywhere") {
    CHECK(run("N7X-108.687Y2.5Z120.G00\n").blocks == Blocks{"X-108.687 Y2.5 Z120 G0"});
    CHECK(run("g1x+1.5 y - 2 z.5f 1000\n").blocks == Blocks{"G1 X1.5 Y-2 Z0.5 F1000"});
    CHECK(run("#1=2\n#32=4.\nE - [ #1 / 4 ] X-#32 Z-[#1+2]\n").blocks == Blocks{"E-0.5 X-4 Z-4"});
    CHECK(run("#4=10\n#7= - #4 -85.\nX#7\n").blocks == Blocks{"X-95"});
    CHECK(run("X1.,R2.\nX1. ,C.5Y2.\n").blocks == Blocks{"X1 r2", "X1 c0.5 Y2"});
}

TEST_CASE("a whole number is told from one with a point") {
    interpreter::ProgramsInMemory none;
    PlainSystem system;
    interpreter::Interpreter nc(none, {}, system, {});
    nc.open(interpreter::ProgramText{"p", "N12G90X58Y58.Z[5]X#1(c)\n", nullptr});
    const interpreter::BlockWords* words = nc.next();
    REQUIRE(words);
    REQUIRE(words->count == 5);
    CHECK(words->sequence_number == 12);
    CHECK(words->line == 1);
    CHECK_FALSE(words->words[1].decimal_point);
    CHECK(words->words[2].decimal_point);
    CHECK(words->words[3].decimal_point);
    CHECK(words->words[4].vacant);
    CHECK(words->words[1].column == 7);
    CHECK(words->words[4].column == 18);
}

TEST_CASE("every line end and every envelope") {
    const Blocks two{"X1", "X2"};
    CHECK(run("X1.\nX2.\n").blocks == two);
    CHECK(run("X1.\r\nX2.\r\n").blocks == two);
    CHECK(run("X1.\rX2.\r").blocks == two);
    CHECK(run("%\n\r\rO1\n\r\rX1.\n\r\rX2.\n\r\r%\n\r\r").blocks == two);
    CHECK(run("X1.\nX2.").blocks == two);
    CHECK(run("\xEF\xBB\xBF%\nO1\nX1.\nX2.\n%").blocks == two);
    CHECK(run("X1.\nX2.\n\x1A").blocks == two);
    CHECK(run("X1.\nX2.\x1A trash").blocks == two);
    CHECK(run("%(CNCID=3C7B5D01,F6914B1A)\nX1.\nX2.\n%\nX3.\n").blocks == two);
    CHECK(run("").blocks.empty());
    CHECK(run("%\n%\n").blocks.empty());
    CHECK(run("X1.;\nX2.;(end)\n").blocks == two);
}

TEST_CASE("lines are counted the same with every line end") {
    for (const std::string end : {"\n", "\r\n", "\r", "\n\r\r"}) {
        const Run r = run("X1." + end + "(c)" + end + end + "?" + end);
        REQUIRE(r.alarm);
        CHECK(r.alarm->where.line == 4);
        CHECK(r.alarm->number == 9);
    }
}

TEST_CASE("comments of any encoding end at the first bracket") {
    CHECK(run("X1.(caf\xE9 \x83\x5C [#1=)Y2.( ( )\n").blocks == Blocks{"X1 Y2"});
    CHECK(run("(2D Chamfer (2)\nX1.\n").blocks == Blocks{"X1"});
    CHECK(alarm_of("(2D Chamfer (2))\n") == 9);
    CHECK(alarm_of("X1.(open\nX2.)\n") == 9);
    interpreter::InterpreterOptions nested;
    nested.dialect.comment_nesting = true;
    CHECK(run("(2D Chamfer (2))X1.\n", nested).blocks == Blocks{"X1"});
    CHECK(run("#100=1(a)+(b)2(c)\nX#100\n").blocks == Blocks{"X3"});
}

TEST_CASE("program numbers, names and folders") {
    CHECK(run("%\n:0100\nX1.\n%").blocks == Blocks{"X1"});
    CHECK(run("<101>M60\nX1.\n").blocks == Blocks{"M60", "X1"});
    CHECK(run("%\n&F=/MTB1/\nO7001\nM98P8898\nO8898(B)\nX8.\nM99\n%").blocks == Blocks{"X8"});
    CHECK(run("O1000(PART)G90\nX1.\n").blocks == Blocks{"G90", "X1"});
}

TEST_CASE("block skip by its switch, also in mid-block") {
    interpreter::InterpreterOptions off, on, second;
    on.skip_switches[1] = true;
    second.skip_switches[2] = true;
    const std::string text = "/X1.\nZ-1.0/M08\n/2X2.\n/\nX#1/2Y3.\n/IF[1EQ1]GOTO9\nN9M30\n";
    CHECK(run(text, off).blocks == Blocks{"X1", "Z-1 M8", "X2", "Y3", "M30"});
    CHECK(run(text, on).blocks == Blocks{"Z-1", "X2", "Y3", "M30"});
    CHECK(run(text, second).blocks == Blocks{"X1", "Z-1 M8", "", "M30"});
}

TEST_CASE("values that are missing or wrong alarm at their place") {
    const auto place = [](const std::string& text, int number, int column) {
        const Run r = run("X0.\n" + text + "\n");
        REQUIRE(r.alarm);
        CHECK(r.alarm->number == number);
        CHECK(r.alarm->where.line == 2);
        CHECK(r.alarm->where.column == column);
    };
    place("P F15.", 5, 1);
    place("G1YH100", 5, 3);
    place("X", 5, 1);
    place("X1.2.3", 7, 5);
    place("X--1.", 6, 3);
    place("G0 5X1.", 4, 4);
    place("X1.?", 9, 4);
    place("<<<<<<< HEAD", 9, 1);
    place("=======", 9, 1);
    place(">>>>>>> other", 9, 1);
    place("X1. #1=2", 127, 5);
    place("X[1.+2.", 1132, 8);
    place("#1", 1133, 3);
    place("#1=[1+*2]", 114, 7);
    place("G0 X1,Q5.", 9, 6);
    place(std::string("X1.\0Y2.", 7), 9, 4);
}

TEST_CASE("more words than a block holds are refused") {
    std::string text;
    for (int i = 0; i < 49; ++i) text += "X1.";
    CHECK(alarm_of(text + "\n") == 1090);
    CHECK(alarm_of(text.substr(3) + "\n") == 0);
}

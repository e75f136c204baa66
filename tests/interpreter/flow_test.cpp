#include <catch2/catch.hpp>

#include "support.h"

using namespace trunnion;
using namespace trunnion::test;

TEST_CASE("GOTO jumps forward, backward and takes the next of duplicate numbers") {
    CHECK(run("GOTO20\nX1.\nN20X2.\n").blocks == Blocks{"X2"});
    const Run r = run("#100=0\nN10#100=#100+1\nX#100\nIF[#100LT3]GOTO10\nX9.\n");
    CHECK(r.blocks == Blocks{"X1", "X2", "X3", "X9"});
    CHECK(run("N5X1.\nGOTO5\nX2.\nN5X3.\nM30\n").blocks == Blocks{"X1", "X3", "M30"});
    CHECK(run("#1=20\nGOTO#1\nX1.\nN20X2.\n").blocks == Blocks{"X2"});
    CHECK(run("#147=3\nGOTO[#147*100]\nX1.\nN300X2.\n").blocks == Blocks{"X2"});
}

TEST_CASE("a jump target that does not exist is alarm 128 at the jump") {
    const Run r = run("X1.\n  GOTO20\n");
    REQUIRE(r.alarm);
    CHECK(r.alarm->number == 128);
    CHECK(r.alarm->where.line == 2);
    CHECK(r.alarm->where.column == 3);
    CHECK(r.alarm->where.program == "main.nc");
    CHECK(r.alarm->block == "  GOTO20");
    CHECK(alarm_of("GOTO#1\n") == 128);
    CHECK(alarm_of("O1\nGOTO5\nM30\nO2\nN5M30\n") == 128);
}

TEST_CASE("GOTO does the same through the cache as at the first reading") {
    const Run r =
        run("#100=0\n#101=0\nN1#100=#100+1\nIF[#100GT50]GOTO99\n"
            "IF[[#100MOD2]EQ0]GOTO2\n#101=#101+100\nGOTO1\nN2#101=#101+1\nGOTO1\nN99M30\n");
    CHECK(r[100] == 51.0);
    CHECK(r[101] == 2525.0);
    CHECK(r.blocks == Blocks{"M30"});
}

TEST_CASE("GOTO with a variable goes where it points each time, through the cache too") {
    const Run r =
        run("#1=1\nN1#9=#9+1\nIF[#9GT9]GOTO99\nGOTO[10*#1]\nN10X1.\n#1=2\nGOTO1\nN20X2.\n#1=3\n"
            "GOTO1\nN30X3.\n#1=4\nGOTO1\nN40X4.\nN99M30\n");
    CHECK(r.blocks == Blocks{"X1", "X2", "X3", "X4", "M30"});
}

TEST_CASE("WHILE loops nest three deep and run the right number of times") {
    const Run r =
        run("#1=0\n#100=0\nWHILE[#1LT3]DO1\n#2=0\nWHILE[#2LT4]DO2\n#3=0\n"
            "WHILE[#3LT5]DO3\n#100=#100+1\n#3=#3+1\nEND3\n#2=#2+1\nEND2\n#1=#1+1\nEND1\n");
    CHECK_FALSE(r.alarm);
    CHECK(r[100] == 60.0);
    CHECK(run("WHILE[1EQ2]DO1\nX1.\nEND1\nX2.\n").blocks == Blocks{"X2"});
    CHECK(run("#1=0\nDO1\n#1=#1+1\nX#1\nIF[#1EQ2]GOTO5\nEND1\nN5M30\n").blocks ==
          Blocks{"X1", "X2", "M30"});
    CHECK(run("#1=1\nWH[#1NE0]DO1\n#1=0\nX1.\nEN1\n").blocks == Blocks{"X1"});
}

TEST_CASE("loop faults") {
    CHECK(alarm_of("#1=1\nWHILE[#1EQ1]DO1\n#1=0\n") == 124);
    CHECK(alarm_of("END1\n") == 1124);
    // A jump into a loop that has run before finds no active DO.
    CHECK(alarm_of("#1=0\nWHILE[#1LT1]DO1\nN5#1=#1+1\nEND1\nGOTO5\nM30\n") == 1124);
    CHECK(alarm_of("WHILE[1EQ1]DO4\nEND4\n") == 126);
    CHECK(alarm_of("WHILE[1EQ1]DO1\nWHILE[1EQ1]DO1\nEND1\nEND1\n") == 124);
    CHECK(alarm_of("WHILE[1EQ1]DO1\nWHILE[1EQ1]DO2\nEND1\nEND2\n") == 124);
    CHECK(alarm_of("WHILE[1EQ1]X1.\n") == 1138);
}

TEST_CASE("IF THEN assigns in the same block, IF GOTO jumps") {
    const Run r =
        run("#100=1\nIF[#100EQ1]THEN#101=5\nIF[#100EQ2]THEN#101=6\nIF[#100EQ1]TH#102=7\n");
    CHECK(r[101] == 5.0);
    CHECK(r[102] == 7.0);
    CHECK(run("N1IF[1EQ1]GOTO20\nX1.\nN20X2.\n").blocks == Blocks{"X2"});
    CHECK(run("IF[1EQ1]GO20(next)\nX1.\nN20X2.\n").blocks == Blocks{"X2"});
}

TEST_CASE("logic between and without brackets") {
    const auto jumps = [](const std::string& setup, const std::string& condition) {
        return run(setup + "\nIF" + condition + "GOTO9\nX1.\nN9M30\n").blocks == Blocks{"M30"};
    };
    CHECK(jumps("", "[#139EQ#0]AND[#13EQ#0]"));
    CHECK_FALSE(jumps("#139=0", "[#139EQ#0]AND[#13EQ#0]"));
    CHECK(jumps("#139=0", "[#139EQ#0]OR[#13EQ#0]"));
    CHECK(jumps("#120=5", "[#120AND3EQ1]"));
    CHECK(jumps("#170=6", "[#170 AND 4 EQ 4]"));
    CHECK_FALSE(jumps("#170=3", "[#170 AND 4 EQ 4]"));
    CHECK(jumps("#1=5", "[[#1GT4]AND[#1LT6]]"));
    CHECK(jumps("#1=5", "[#1+1EQ2*3]"));
}

TEST_CASE("what is not Fanuc's is refused and named") {
    const auto text = [](const std::string& program) {
        const Run r = run(program);
        REQUIRE(r.alarm);
        return r.alarm->text;
    };
    CHECK(text("IF[1EQ1]THEN GOTO6\nN6\n").find("Fanuc") != std::string::npos);
    CHECK(text("IF[1EQ1]THEN\n#1=1\nENDIF\n").find("ENDIF") != std::string::npos);
    CHECK(text("#<_x>=1\n").find("LinuxCNC") != std::string::npos);
    CHECK(text("#1=#<_x>\n").find("LinuxCNC") != std::string::npos);
    CHECK(text("o100 while [#1 LT 3]\n").find("LinuxCNC") != std::string::npos);
    CHECK(text("G0 X1. ; comment\n").find("Fanuc") != std::string::npos);
    CHECK(alarm_of("IF[1EQ1]GOTO\n") == 128);
    CHECK(alarm_of("IF[1EQ1]X1.\n") == 1137);
    CHECK(alarm_of("IF[1EQ1]\n") == 1137);
    CHECK(alarm_of("IF#1EQ1GOTO5\n") == 1137);
}

TEST_CASE("the block limit stops an endless loop") {
    interpreter::InterpreterOptions options;
    options.max_blocks = 1000;
    const Run r = run("N1GOTO1\n", options);
    CHECK(r.limit);
    CHECK(r.executed == 1000);
    CHECK_FALSE(r.alarm);
}

TEST_CASE("a watcher is asked now and then and may stop the run; the block limit still counts") {
    std::vector<std::uint64_t> asked;
    interpreter::InterpreterOptions options;
    options.max_blocks = 20000;
    options.go_on = [&](std::uint64_t blocks) {
        asked.push_back(blocks);
        return blocks < 10000;
    };
    const Run stopped = run("N1GOTO1\n", options);
    CHECK(stopped.limit);
    REQUIRE(asked.size() == 4);
    CHECK(asked.back() == stopped.executed);
    CHECK(stopped.executed > 12280);
    CHECK(stopped.executed <= 12288);
    options.go_on = [](std::uint64_t) { return true; };
    CHECK(run("N1GOTO1\n", options).executed == 20000);
    options.max_blocks = 4096;
    CHECK(run("N1GOTO1\n", options).executed == 4096);
}

TEST_CASE("the block limit also stops loops over empty lines and searches over many numbers") {
    std::string text;
    for (int i = 0; i < 310000; ++i) text += "N2\n";
    interpreter::InterpreterOptions options;
    options.max_blocks = 1000;
    const Run looped = run("N1\n" + text + "GOTO1\n", options);
    CHECK(looped.limit);
    CHECK(looped.executed < 10);
    const Run searched = run("N1\nGOTO3\n" + text + "N3GOTO1\n", options);
    CHECK(searched.limit);
    CHECK(searched.executed < 1000);
}

TEST_CASE("a line of any length ends in an alarm before it fills the memory") {
    std::string words, sum = "#1=1", comments;
    for (int i = 0; i < 200000; ++i) {
        words += "G1";
        sum += "+1";
        comments += "(A)";
    }
    CHECK(alarm_of(words + "\n") == 1090);
    CHECK(alarm_of(sum + "\n") == 1090);
    CHECK(alarm_of("G1" + comments + "X1.\n") == 0);
}

TEST_CASE("a loop larger than the block cache runs right") {
    std::string text = "#1=0\n#100=0\nWHILE[#1LT3]DO1\n";
    for (int i = 0; i < 40000; ++i) text += i % 4000 == 0 ? "#100=#100+1\n" : "X1.\n";
    text += "#1=#1+1\nEND1\n#1=0\nWHILE[#1LT50]DO1\n#1=#1+1\nEND1\n";
    interpreter::InterpreterOptions options;
    options.max_blocks = 1000000;
    const Run r = run(text, options);
    CHECK_FALSE(r.alarm);
    CHECK(r[100] == 30.0);
    CHECK(r.blocks.size() == 3u * (40000u - 10u));
}

TEST_CASE("a sequence number behind a comment is a target, too") {
    CHECK(run("GOTO20\nX1.\n(here)(now)N20X2.\n").blocks == Blocks{"X2"});
    CHECK(run("GOTO20\nX1.\n/2 N20X2.\n").blocks == Blocks{"X2"});
    CHECK(alarm_of("GOTO20\nX1.\n(N20)X2.\n") == 128);
}

TEST_CASE("a skipped branch is left at its own ENDIF, whatever its comments say") {
    interpreter::InterpreterOptions options;
    options.dialect = interpreter::fanuc_dialect(interpreter::ControlGeneration::fanuc_0i_f);
    const char* nested = "IF[0EQ1]THEN\nIF[1EQ1]THEN (a remark)\nX1.\nENDIF\nX2.\nENDIF\nX3.\n";
    CHECK(run(nested, options).blocks == Blocks{"X3"});
    const char* jump = "IF[0EQ1]THEN\nIF[1EQ0]GOTO9(SO THEN)\nENDIF\nX3.\nN9X4.\n";
    CHECK(run(jump, options).blocks == Blocks{"X3", "X4"});
    const char* loop = "IF[0EQ1]THEN\nDO1\nX1.\nEND1\nX2.\nENDIF\nX3.\n";  // END1 is no ENDIF
    CHECK(run(loop, options).blocks == Blocks{"X3"});
}

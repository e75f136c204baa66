#include <catch2/catch.hpp>

#include "support.h"

using namespace trunnion;
using namespace trunnion::test;

TEST_CASE("arithmetic in Fanuc's order") {
    CHECK(value_of("1+2*3") == 7.0);
    CHECK(value_of("[1+2]*3") == 9.0);
    CHECK(value_of("10-4-3") == 3.0);
    CHECK(value_of("16/4/2") == 2.0);
    CHECK(value_of("-2+5") == 3.0);
    CHECK(value_of("7MOD3") == 1.0);
    CHECK(value_of("7.5 MOD 2") == 1.5);
    CHECK(value_of("-7 MOD 3") == -1.0);
    CHECK(value_of("1 OR 6 AND 4") == 5.0);
    CHECK(value_of("12 XOR 10") == 6.0);
    CHECK(value_of("6AN3") == 2.0);
    CHECK(value_of("2*3AND2") == 2.0);
}

TEST_CASE("functions") {
    CHECK(value_of("SIN[30]") == Approx(0.5).epsilon(1e-15));
    CHECK(value_of("SIN[180]") == 0.0);
    CHECK(value_of("COS[90]") == 0.0);
    CHECK(value_of("COS[-270]") == 0.0);
    CHECK(value_of("SIN[-90]") == -1.0);
    CHECK(value_of("TAN[45]") == Approx(1.0));
    CHECK(value_of("SQRT[2.25]") == 1.5);
    CHECK(value_of("SQ[4]") == 2.0);
    CHECK(value_of("ABS[-3.5]") == 3.5);
    CHECK(value_of("BIN[291]") == Approx(123.0));  // 0x123
    CHECK(value_of("BCD[123]") == 291.0);
    CHECK(value_of("ROUND[1.5]") == 2.0);
    CHECK(value_of("ROUND[-1.5]") == -2.0);
    CHECK(value_of("FIX[-1.7]") == -1.0);
    CHECK(value_of("FUP[-1.2]") == -2.0);
    CHECK(value_of("FUP[1.2]") == 2.0);
    CHECK(value_of("LN[EXP[2]]") == Approx(2.0));
    CHECK(value_of("POW[2,10]") == 1024.0);
    CHECK(value_of("PRM[1321]/[3]") == Approx(1321 - 0.1 + 0.03));
    CHECK(value_of("PRM[7811]") == Approx(7811 - 0.11));
    CHECK(value_of("PRM[6004,2]") == Approx(6004 + 0.2 - 0.01));
    CHECK(value_of("AT[1]/[1]") == Approx(45.0));
}

TEST_CASE("arc functions and their ranges by parameter 6004#0") {
    interpreter::InterpreterOptions nat;
    nat.asin_0_to_minus_90 = true;
    CHECK(value_of("ATAN[-1]/[1]") == Approx(315.0));
    CHECK(value_of("ATAN[-1]/[1]", nat) == Approx(-45.0));
    CHECK(value_of("ATAN[1]/[-1]", nat) == Approx(135.0));
    CHECK(value_of("ATAN[1,-1]", nat) == Approx(135.0));
    CHECK(value_of("ATAN[-1]") == Approx(-45.0));
    CHECK(value_of("[ATAN[1]]/5") == Approx(9.0));
    CHECK(value_of("ASIN[-0.5]") == Approx(330.0));
    CHECK(value_of("ASIN[-0.5]", nat) == Approx(-30.0));
    CHECK(value_of("ACOS[-0.5]") == Approx(120.0));
}

TEST_CASE("arithmetic faults") {
    CHECK(alarm_of("#1=1/0\n") == 112);
    CHECK(alarm_of("#1=1/#2\n") == 112);
    CHECK(alarm_of("#1=SQRT[-1]\n") == 119);
    CHECK(alarm_of("#1=ASIN[1.01]\n") == 119);
    CHECK(alarm_of("#1=LN[0]\n") == 119);
    CHECK(alarm_of("#1=TAN[90]\n") == 119);
    CHECK(alarm_of("#1=EXP[500]\n") == 111);
    CHECK(alarm_of("#1=POW[10,60]\n") == 111);
    CHECK(alarm_of("#1=5MOD0\n") == 112);
    CHECK(alarm_of("#1=#50\n") == 115);
    CHECK(alarm_of("#50=1\n") == 115);
    CHECK(alarm_of("#0=1\n") == 116);
    CHECK(alarm_of("#1=[[[[[[1]]]]]]\n") == 118);
    CHECK(alarm_of("#1=[[[[[1]]]]]\n") == 0);
    CHECK(alarm_of("#1=[ABS[LN[ABS[ACOS[SIN[#1]*0.9]]+2.]]]\n") == 0);
    std::string deep;
    for (int i = 0; i < 40; ++i) deep += "ABS[";
    CHECK(alarm_of("#1=" + deep + "\n") == 118);
    CHECK(alarm_of("#1=1 AND 1E10\n") != 0);
    CHECK(alarm_of("#1=5000000000 AND 1\n") == 110);
    CHECK(alarm_of("#1=##2\n") == 114);
    CHECK(alarm_of("#1=POW[2]\n") == 1134);
    CHECK(alarm_of("#1=BIN[10]\n") == 119);
    const Run r = run("#1 = 1 + 2 / 0\n");
    REQUIRE(r.alarm);
    CHECK(r.alarm->where.column == 12);
}

TEST_CASE("vacant is not zero, but counts 0 in arithmetic") {
    const auto holds = [](const std::string& setup, const std::string& condition) {
        return run(setup + "\nIF[" + condition + "]THEN#100=1\n")[100] == 1.0;
    };
    CHECK(holds("", "#101EQ#0"));
    CHECK_FALSE(holds("", "#101EQ0"));
    CHECK(holds("", "#101NE0"));
    CHECK_FALSE(holds("", "#101NE#0"));
    CHECK(holds("", "#101GE#0"));
    CHECK_FALSE(holds("", "#101GT0"));
    CHECK_FALSE(holds("#101=0", "#101EQ#0"));
    CHECK(holds("#101=0", "#101EQ0"));
    CHECK(holds("#101=0", "#101NE#0"));
    const Run r = run("#100=#1\n#101=#1*5\n#102=#1+#1\n#103=[#1]\n#104=5\n#104=#0\n");
    CHECK(interpreter::is_vacant(r[100]));
    CHECK(r[101] == 0.0);
    CHECK(r[102] == 0.0);
    CHECK(interpreter::is_vacant(r[103]));
    CHECK(interpreter::is_vacant(r[104]));
    CHECK(run("G0X#1Y2.Z-#1\n").blocks == Blocks{"G0 Y2"});
    CHECK(run("X[#1+1.]\n").blocks == Blocks{"X1"});
}

TEST_CASE("indirect variables and system variables") {
    const Run r = run("#1=101\n#[#1]=5.\n#[#1+1]=#[#1]*2\n#5221=3.5\n#104=#5221\n");
    CHECK(r[101] == 5.0);
    CHECK(r[102] == 10.0);
    CHECK(r[104] == 3.5);
    CHECK(alarm_of("#1=#5999\n") == 115);
    CHECK(run("#98000=4.\n#100=#98000\n")[100] == Approx(4.0));
    interpreter::InterpreterOptions thirty;
    thirty.dialect = interpreter::fanuc_dialect();
    CHECK(run("#98499=4.\n#100=#98499\n", thirty)[98499] == 4.0);
}

TEST_CASE("assignments take effect at once") {
    CHECK(run("#100=1\nX#100\n#100=#100+1\nX#100\n").blocks == Blocks{"X1", "X2"});
}

TEST_CASE("#3000 and #3006 take the comment of their block") {
    const Run alarm = run("X1.\n(check)#3000=12(TOOL BROKEN)\n");
    REQUIRE(alarm.alarm);
    CHECK(alarm.alarm->number == 3012);
    CHECK(alarm.alarm->text == "TOOL BROKEN");
    CHECK(alarm.alarm->where.line == 2);
    const Run stop = run("#33=0\n#[3006-[#33*6]]=1(LOAD PART)\n");
    CHECK(stop.system.comments.at(3006) == "LOAD PART");
    const Run then = run("IF[1EQ1]THEN#3000=5(E)\n");
    CHECK(then.alarm->number == 3005);
}

TEST_CASE("ROUND in a word keeps the least increment, elsewhere whole numbers") {
    CHECK(run("#1=1.23456\nX[ROUND[#1]]Y[ROUND[#1]+#1]M[ROUND[#1]]\n").blocks ==
          Blocks{"X1.235 Y2.46956 M1"});
    CHECK(run("#1=1.23456\n#2=ROUND[#1]\nX#2\n").blocks == Blocks{"X1"});
}

TEST_CASE("computed G and M words") {
    CHECK(run("#4012=54.\n").blocks.empty());
    Run start;
    start.system.values[4012] = 55.0;
    interpreter::ProgramsInMemory none;
    CHECK(run_on(none, "#1=26\n#33=8\nG#4012X1.\nG[59+[#1-6]/10]\nM#33\n", {}, start).blocks ==
          Blocks{"G55 X1", "G61", "M8"});
}

TEST_CASE("DPRNT prints with Fanuc's spacing") {
    const std::string set = "#102=128.47398\n#105=-91.2\n#130=123.456\n";
    CHECK(run(set + "POPEN\nDPRNT[X#102[53] Y#105[53] T#130[20]]\nPCLOS\n").printed ==
          "X   128.474Y-   91.200T 23\n");
    interpreter::InterpreterOptions suppress;
    suppress.print_suppresses_blanks = true;
    CHECK(run(set + "DPRNT[X#102[53]Y#105[53]T#130[20]]\n", suppress).printed ==
          "X128.474Y-91.200T23\n");
    CHECK(run("#24=1.5\n#135=2\nDPRNT[POSNX/#24[44]/**ACTUAL/#135[44]]\n").printed ==
          "POSNX/    1.5000/  ACTUAL/    2.0000\n");
    CHECK(run("DPRNT[]\n").printed == "\n");
    CHECK(run("DPRNT[A#1[31]]\n").printed == "A   0.0\n");
    CHECK(run("#1=-0.0004\nDPRNT[A#1[33]]\n").printed == "A   0.000\n");
    CHECK(run("#1=103\n#103=7\nDP[N#[#1][20]]\n").printed == "N  7\n");
    CHECK(run("#1=-1.5\nBPRNT[C*#1[3]]\n").printed == std::string("C \xFF\xFF\xFA\x24\n", 7));
    CHECK(alarm_of("DPRNT[A#1]\n") == 1143);
    CHECK(alarm_of("DPRNT[A\n") == 1143);
    CHECK(run("#100=0\nWHILE[#100LT3]DO1\nDPRNT[N#100[10]]\n#100=#100+1\nEND1\n").printed ==
          "N 0\nN 1\nN 2\n");
}

#include "interpreter/print.h"

#include <catch2/catch.hpp>

#include "support.h"
#include "tests/support/printed_program.h"

using namespace trunnion;
using namespace trunnion::test;

namespace {

std::string printed(const std::string& text) {
    std::string out =
        interpreter::print_program(interpreter::parse_program({"p", text, nullptr}, {}));
    if (!out.empty()) out.pop_back();
    return out;
}

/// Law 3: parse, print, parse gives the same blocks, and printing again the same text.
void check_fixpoint(const std::string& text) {
    const auto [once, again] = check_print(text, {});
    CHECK(again == once);
}

}  // namespace

TEST_CASE("canonical text") {
    CHECK(printed("n7x-108.687y2.5z120.g00") == "N7 X-108.687 Y2.5 Z120. G0");
    CHECK(printed("x1.,r2.f100(c)") == "X1. ,R2. F100 (c)");
    CHECK(printed(":100(NAME)") == "O0100 (NAME)");
    CHECK(printed("/2N5 G1/X1.") == "N5 /2G1 /X1.");
    CHECK(printed("#1=[[#2*[3+#4]]]") == "#1=#2*[3+#4]");
    CHECK(printed("#1=2-[3-4]-[5*6]") == "#1=2-[3-4]-5*6");
    CHECK(printed("#1=-[#2+1]*-3") == "#1=-[#2+1]*-3");
    CHECK(printed("IF[#139EQ#0]AND[#13EQ#0]GOTO310") == "IF[[#139 EQ #0] AND [#13 EQ #0]] GOTO310");
    CHECK(printed("WH[#1NE0]DO1") == "WHILE[#1 NE 0] DO1");
    CHECK(printed("#1=AT[#2]/[#3]") == "#1=ATAN[#2]/[#3]");
    CHECK(printed("#1=[ATAN[#2]]/[#3+1]") == "#1=[ATAN[#2]]/[#3+1]");
    CHECK(printed("#1=PRM[1,2]/[3]/[#4+1]") == "#1=PRM[1,2]/[3]/[#4+1]");
    CHECK(printed("X-#1Y-[#2]Z[5.]") == "X-#1 Y-#2 Z[5]");
    CHECK(printed("IF[#1EQ1]TH#[3006-#2]=1(T)") == "IF[#1 EQ 1] THEN #[3006-#2]=1 (T)");
    CHECK(printed("DP[ A#1[44] B ]") == "DPRNT[A#1[44]B]");
}

TEST_CASE("parse, print, parse is a fixpoint") {
    for (const char* text :
         {"%\nO1000(A)\nN10G90G0X0Y58\n/2/3X1.\nZ-1.0/M08\n%\n",
          "#1=[#2AND[3OR4]]XOR5\n#2=#1MOD[3MOD2]\n#3=[#1EQ#2]\n#4=1-[2-3]-[4/[5/6]]*[7+8]\n",
          "#1=PRM[1321]/[3]+PRM[7811]*PRM[6004,2]/[PRM[1,2]/[3]]\n#2=[PRM[1]]/[#3]\n",
          "#1=2*[ATAN[1]]/[#2]\n#2=ATAN[1]/5\n#3=ATAN[1,2]/[3]\n#4=[2*ATAN[1]]/[#2]\n",
          "#1=-[-#2]\n#1=-#2*-3\n#1=[-2]*3-[-4]\n#[#[#1]+2]=POW[#1,-2]\nX[ROUND[#1]]\n",
          "G#401B#2\nG[59+[#1-6]/10]\nM#33\nX#[#1+1]Y-#[5]Z-[#5*2]\n",
          "WHILE[[#1LT3]AND[#2GT[4+5]]]DO2\nEND2\nDO1\nEND1\nGOTO[#147*100]\nGOTO#140\n",
          "G90M98<SUB-1>L2\nG65 <A B>A5.\nDPRNT[]/2\nBPRNT[DPRNT[#1[2]]\n",
          "POPEN\nDPRNT[POSNX/#24[44]/**ACTUAL/#[135+#1][08]]\nBPRNT[C*#1[3]]\nPCLOS\n",
          "SETVN500[LEN,,RAD]\n#1=#[#RAD]\n<NAME-1>M60\n&F=/MTB1/\nO7001G90N5\n",
          "(a)#3000=1(b)(c)\n#100=1(a)+(b)2\nX.5Y5.Z-0.F1.000\nG5.1Q1\nC-145318.181\n",
          "X.000000000000001\nX123456789012345\n#1=.000000000000001\n",
          "#111=[ACOS[SIN[[[5.113*18.195]-SQRT[ABS[#110]+1.]]]*0.9]]\n",
          "IF[[[[[#1EQ1]]]]]GOTO5\nIF[[[[[#1+1]*2]+1]*3]EQ1]AND[[[[[#1+1]*2]+1]*3]EQ2]GOTO5\n"})
        check_fixpoint(text);
}

TEST_CASE("a parsed program knows its structure and keeps faults with their places") {
    const interpreter::ParsedProgram p = interpreter::parse_program(
        {"f.nc", "%\r\nO10(T)\r\nN5G1X1.\r\nX?\r\nIF[#1EQ1]GOTO5\r\nGOTO[7]\r\n%", nullptr}, {});
    REQUIRE(p.faults.size() == 1);
    CHECK(p.faults[0].number == 5);
    CHECK(p.faults[0].where.program == "f.nc");
    CHECK(p.faults[0].where.line == 4);
    CHECK(p.faults[0].block == "X?");
    REQUIRE(p.blocks.size() == 6);
    CHECK(p.blocks[0].kind == interpreter::BlockKind::end_of_record);
    CHECK(p.blocks[1].kind == interpreter::BlockKind::program);
    CHECK(p.blocks[1].o_number == 10);
    CHECK(p.text(p.comments(p.blocks[1])[0]) == "T");
    CHECK(p.blocks[2].sequence_number == 5);
    CHECK(p.text(p.blocks[2]) == "N5G1X1.");
    const auto jump = p.items(p.blocks[3]);
    CHECK(p.blocks[3].line == 5);
    REQUIRE(jump.size() == 2);
    CHECK(jump[0].kind == interpreter::ItemKind::if_goto);
    CHECK(jump[1].kind == interpreter::ItemKind::go_to);
    CHECK(interpreter::constant_value(p, jump[1]) == 5.0);
    CHECK(interpreter::constant_value(p, p.items(p.blocks[4])[0]) == 7.0);
}

#include <catch2/catch.hpp>
#include <set>

#include "support.h"

using namespace trunnion;
using namespace trunnion::test;

TEST_CASE("every alarm of the language is reached by a program") {
    std::string sets = "G65P9";
    for (int i = 0; i < 11; ++i) sets += "K1.";
    const std::vector<std::pair<int, std::string>> programs{
        {3, "X1234567890123456\n"},
        {4, "G0 5\n"},
        {5, "G0X\n"},
        {6, "X+-1\n"},
        {7, "N1.X1\n"},
        {9, "X1.$\n"},
        {76, "G65P9\n"},
        {77, "M98P9\nM30\nO9\nM98P9\n"},
        {78, "M98P9Q5\nM30\nO9\nM99\n"},
        {110, "#1=9999999999 OR 1\n"},
        {111, "#1=EXP[900]\n"},
        {112, "#1=1/[#2-0]\n"},
        {114, "#1=[*2]\n"},
        {115, "#34=1\n"},
        {116, "#0=1\n"},
        {118, "#1=[[[[[[2]]]]]]\n"},
        {119, "#1=SQRT[-2]\n"},
        {122, "G65P9\nM30\nO9\nG65P9\n"},
        {124, "WHILE[1EQ1]DO1\n"},
        {125, "ENDIF\n"},
        {126, "DO5\n"},
        {127, "#1=1X1.\n"},
        {128, "GOTO5\n"},
        {129, "G65P9A1.O5\nO9\n"},
        {1090, "o10 sub\n"},
        {1095, sets + "\nO9\nM99\n"},
        {1096, "#1=#[#NOBODY]\n"},
        {1124, "END1\n"},
        {1131, "#1=SIN 30\n"},
        {1132, "X[1.\n"},
        {1133, "#1 5\n"},
        {1134, "#1=POW[2]\n"},
        {1137, "IF[1EQ1]\n"},
        {1138, "WHILE[1EQ1]\n"},
        {1139, "SETVN500\n"},
        {1143, "DPRNT[#1]\n"},
        {1144, "G10L85P500(XYZ)\n"},
    };
    std::set<int> reached;
    for (const auto& [number, program] : programs) {
        INFO(program);
        CHECK(alarm_of(program) == number);
        reached.insert(number);
    }
    for (const interpreter::AlarmInfo& row : interpreter::language_alarms()) {
        INFO(row.number);
        CHECK(reached.count(row.number) == 1);
        CHECK(std::string(row.cause).size() > 5);
        CHECK(std::string(row.remedy).size() > 5);
        CHECK(interpreter::language_alarm(row.number) == &row);
    }
    CHECK(interpreter::language_alarm(1) == nullptr);
}

TEST_CASE("each way to an alarm of the language") {
    const std::string long_name(33, 'A');
    const std::vector<std::pair<int, std::string>> programs{
        // numbers of programs, blocks and skips
        {5, "OX\n"},
        {7, "O1.5\n"},
        {3, "O123456789\n"},
        {5, "NX1\n"},
        {3, "N1234567890\n"},
        {4, "/0X1\n"},
        // names
        {9, "<>\n"},
        {9, "<NAME\n"},
        {9, "<A*B>\n"},
        {9, "<" + long_name + ">\n"},
        {9, "M98<" + long_name + ">\n"},
        {1096, "X#[#PART_2]\n"},
        // words and values
        {9, "X1.,Q2.\n"},
        {7, "X.\n"},
        {7, "X1.2.\n"},
        {6, "#1=-+1\n"},
        {114, "#1=FOO[1]\n"},
        {7, "#1=.\n"},
        {3, "#1=1234567890123456\n"},
        {7, "#1=1.2.3\n"},
        {7, "#1.5=1\n"},
        {115, "#1234567890=1\n"},
        // statements
        {1138, "WHILE 1EQ1]DO1\n"},
        {1138, "WHILE[1EQ1]5\n"},
        {126, "WHILE[1EQ1]DO1.\n"},
        {126, "DO0\n"},
        {126, "WHILE[1EQ1]DO\n"},
        {128, "GOTOX\n"},
        {7, "GOTO1.5\n"},
        {1143, "DPRNT X\n"},
        {1143, "DPRNT[X\n"},
        {1143, "DPRNT[#1[X]]\n"},
        {1143, "DPRNT[#1[12X]]\n"},
        {1143, "BPRNT[#1[X]]\n"},
        {1139, "SETVN[A]\n"},
        {1139, "SETVN1234567890[A]\n"},
        {1139, "SETVN5.5[A]\n"},
        {1139, "SETVN500[A\n"},
        // functions outside their range
        {119, "#1=ATAN[0]/[0]\n"},
        {119, "#1=ASIN[1.001]\n"},
        {119, "#1=ACOS[-1.001]\n"},
        {119, "#1=BIN[10]\n"},
        {119, "#1=BCD[-1]\n"},
        {119, "#1=BCD[100000000]\n"},
        {110, "#1=-3000000000 OR 1\n"},
        {112, "#1=POW[0,-1]\n"},
        {119, "#1=POW[-2,0.5]\n"},
        {119, "#1=LN[0]\n"},
        {110, "#1=PRM[9999999999]\n"},
    };
    for (const auto& [number, program] : programs) {
        INFO(program);
        CHECK(alarm_of(program) == number);
    }
}

TEST_CASE("an alarm inside a called program shows that program's place") {
    interpreter::ProgramsInMemory folder;
    folder.add(50, "O0050\nX1.\n  #1=1/0\nM99\n");
    const Run r = run_on(folder, "X0.\nM98P50\n");
    REQUIRE(r.alarm);
    CHECK(r.alarm->number == 112);
    CHECK(r.alarm->text == "ZERO DIVIDE");
    CHECK(r.alarm->where.program == "O0050");
    CHECK(r.alarm->where.line == 3);
    CHECK(r.alarm->where.column == 7);
    CHECK(r.alarm->block == "  #1=1/0");
}

TEST_CASE(
    "a sign that stands alone is alarm 6, a variable without a value source shows its column") {
    CHECK(alarm_of("X1. +5.\n") == 6);
    CHECK(alarm_of("-5.\n") == 6);
    const Run r = run("X0.\n#100=1+#5999\n");
    REQUIRE(r.alarm);
    CHECK(r.alarm->number == 115);
    CHECK(r.alarm->where.line == 2);
    CHECK(r.alarm->where.column == 8);
}

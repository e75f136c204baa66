#include "interpreter/program_likeness.h"

#include <catch2/catch.hpp>

#include "base/alarm.h"

namespace trunnion::interpreter {

namespace {

void look_at(const std::string& text) {
    refuse_other_files({"a.nc", text, nullptr});
}

}  // namespace

TEST_CASE("a table, a setup, a letter and bytes are no NC program") {
    for (const char* text :
         {"1.5,2.5,3\n2.5,3.5,4\n", "N,x_mm,y_mm\nN10,1.0,2.0\nN20,1.5,2.0\n", "1;2;3\n2;3;4\n",
          "[machine]\nname = \"m\"\nchain = \"w X Y Z t\"\n", "{\n \"schema\": 1\n}\n",
          "Dear operator,\nplease run this\nbefore noon\n"})
        CHECK_THROWS_AS(look_at(text), InputError);
    CHECK_THROWS_AS(look_at(std::string("G0 X1\0G1", 8)), InputError);
    CHECK_THROWS_AS(look_at("\x89PNG\r\n\x1a\n"), InputError);
    CHECK_NOTHROW(look_at(std::string("G0 X1\nM30\n\x1a\0\0", 13)));
}

TEST_CASE("a program with lines that a control refuses is one") {
    for (const char* text :
         {"%\nO1000 (PART, 2)\nN10 G0 X1. Y2.\n/N20 G1 Z-1. F100\nM30\n%\n", "g0 x1\ng1 y2\n",
          "#1=ATAN[1.,2.]\nIF[#1GT3]GOTO 10\nWHILE[#2LT3]DO1\nEND1\nN10 M99\n",
          "G1 X10. ,C2.\nG1 Y5.,R3.\nG1 X3.\n", "IF[#1EQ1]THEN #2=3\nWH[#1LT2]DO1\nEND1\nM30",
          "hello world\nG0 X1.\nG1 Y2.\nM30\n", "(A, B)\n:1234\nG0 X-1.\n"})
        CHECK_NOTHROW(look_at(text));
}

}  // namespace trunnion::interpreter

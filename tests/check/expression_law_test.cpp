// The law of law_test.cpp for what is computed: expressions, variables that the program sets, block
// skip, data entry. Without TRUNNION_LAW_SEED always the same programs.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cstdlib>

#include "tests/check/law.h"

using namespace trunnion;

namespace {

const std::string head = "O8\nG21G90G17G94G54F200.S500M3\n";

/// One of the lines, with values for @ and variables for &. Every value follows from the program.
std::string random_line(SeededNoise& noise) {
    static const std::vector<std::string> values = {"0",        "1",
                                                    "-1",       "2.5",
                                                    "98",       "6000",
                                                    "99999",    "#100",
                                                    "[1+2]",    "[1/0]",
                                                    "#0",       "SQRT[-1]",
                                                    "ASIN[2]",  "[#100EQ7]",
                                                    "FIX[2.7]", "ATAN[0]/[0]",
                                                    "LN[0]",    "POW[0,-1]",
                                                    "[-1OR2]",  "TAN[90]",
                                                    "EXP[800]", "ROUND[2.5]",
                                                    "BCD[-1]",  "[7MOD0]",
                                                    "#[100]",   "[#100/[#100-7]]",
                                                    "[0*#100]", "[#100*50]",
                                                    "BIN[255]", "0.000000001"};
    static const std::vector<std::string> variables = {"1",   "33", "100", "149",  "500", "999",
                                                       "300", "0",  "34",  "3901", "2001"};
    static const std::vector<std::string> lines = {"#&=@",
                                                   "#[@]=@",
                                                   "IF[@LT@]THEN#&=@",
                                                   "#&=@/@",
                                                   "N5",
                                                   "POPEN",
                                                   "PCLOS",
                                                   "DPRNT[X#&[53]]",
                                                   "SETVN500[ABC]",
                                                   "//G0",
                                                   "/ G0 X1.",
                                                   "M98 P@",
                                                   "G54.1 P@",
                                                   "G54.2 P@",
                                                   "G10 L2 P@ X@",
                                                   "G10 L20 P@ X@",
                                                   "G10 L@ P@ R@",
                                                   "G10 L50",
                                                   "G11",
                                                   "G4 P@",
                                                   "G43 H@",
                                                   "G41 D@",
                                                   "G2 X@ Y@ R@",
                                                   "G3 I@ J@",
                                                   "G68 X0 Y0 R@",
                                                   "G51 X0 Y0 P@",
                                                   "G30 P@ X0",
                                                   "G53 X@",
                                                   "G52 X@",
                                                   "G92 X@",
                                                   "G96 S@ P@",
                                                   "T@ M6",
                                                   "S@ M3",
                                                   "F@",
                                                   "X@ Y@",
                                                   "G0 X[@]",
                                                   "G7.1 C@",
                                                   "G67 J@",
                                                   "M@",
                                                   "G@",
                                                   "G83Z-5.R2.Q@F9",
                                                   "G81Z-5.R2.F@L1.",
                                                   "G12.1",
                                                   "G68.2 X0 Y0 Z0 I@ J@ K@",
                                                   "G53.1",
                                                   "#3006=@"};
    std::string line = law::pick(noise, lines);
    for (std::size_t at = 0; (at = line.find_first_of("@&", at)) != line.npos;)
        line.replace(at, 1, law::pick(noise, line[at] == '@' ? values : variables));
    return line;
}

std::uint64_t wish(const char* name, std::uint64_t otherwise) {
    const char* const text = std::getenv(name);
    return text ? std::strtoull(text, nullptr, 10) : otherwise;
}

}  // namespace

TEST_CASE("what run refuses in a program that knows all its values, check refuses", "[check]") {
    SeededNoise noise(wish("TRUNNION_LAW_SEED", 71));
    int refused = 0, passed = 0;
    for (std::uint64_t i = 0, most = wish("TRUNNION_LAW_BLOCKS", 4000); i < most; ++i) {
        std::string text = head + "#100=7\n";
        const int lines = 1 + static_cast<int>(noise.uniform() * 3.0);
        for (int k = 0; k < lines; ++k) text += random_line(noise) + "\n";
        const law::Outcome out = law::judge(text + "M30\n");
        const auto& alarm = out.run.alarm;
        INFO(text << (alarm ? fmt::format("run: {} {} in line {}", alarm->number, alarm->text,
                                          alarm->where.line)
                            : "runs"));
        if (alarm) CHECK(out.refused_by_check(alarm->where.line));
        if (!alarm)
            for (const check::Finding& found : out.findings)
                // A variable that cannot be written is told also behind a condition that is false.
                CHECK((found.rule == "variable" || found.severity != check::Severity::error));
        ++(alarm ? refused : passed);
    }
    CHECK(refused > passed / 4);
    CHECK(passed > refused / 10);
}

TEST_CASE("a line that sets a variable does not weaken the check of the next ones", "[check]") {
    const std::string before =
        GENERATE("", "#100=7\n", "#100=#101\n", "#1=2 #2=#1*3\n", "#2001=5.\n",
                 "IF[#101EQ1]THEN#5=2\n", "/#100=7\n", "DPRNT[A#101[53]]\n");
    const std::string block =
        GENERATE("G10L20P1000X0", "G10L50\nPCLOS", "G10L50\n//G0", "G12.1\nG41D1X1.", "G53.1",
                 "G2X10.R1.", "F[1/0]", "G54.1P[-1OR2]", "G67J[1/0]", "M98P0.000000001");
    const law::Outcome out = law::judge(head + before + block + "\nM30\n");
    INFO(before << block);
    CHECK(out.run.alarm);
    CHECK(out.refused_by_check());
}

TEST_CASE("an alarm for every value of an unknown variable is found, others are not", "[check]") {
    for (const char* block : {"X[#500/0]", "X#[#500+1/0]", "X#500 C12345678901", "#[300]=#500",
                              "#500=PRM[1234567890]", "GOTO#0", "IF[#500EQ[1MOD0]]GOTO5",
                              "WHILE[[1/0]LT#500]DO1\nEND1", "#500=#[-1]", "#[0]=#500"}) {
        INFO(block);
        CHECK(law::judge(head + block + "\nN5M30\n").refused_by_check());
    }
    for (const char* block : {"X[0/#500]", "G54.1P#500", "G54.1P[#500+1]", "X[1/#500]", "E#500",
                              "IF[#500EQ1]THEN#1=[1/#2]", "IF[1EQ2]THEN#5=[1/0]", "#[#500]=1"}) {
        INFO(block);
        CHECK_FALSE(law::judge(head + block + "\nN5M30\n").refused_by_check());
    }
}

TEST_CASE("values carried by check are those of a run", "[check]") {
    const std::string block =
        GENERATE("X[#1+1]", "G54.1P[#1-3]", "#1=#1+300\nG54.1P#1", "G20\nX[ROUND[#1]]\nG10L20P1000",
                 "IF[#1EQ4]THEN#1=400\nG54.1P#1", "IF[#1NE4]THEN#1=400\nG54.1P#1",
                 "G54.1P[ATAN[-#1]/[#1]]", "#500=#1\n#1=#0\nG54.1P#1", "X#0\nG54.1P[#500]");
    INFO(block);
    const law::Outcome out = law::judge(head + "#1=4.\n#500=99\n" + block + "\nM30\n");
    CHECK(out.refused_by_check() == out.run.alarm.has_value());
}

// What check says of a block depends on whether a run comes to it.
#include <catch2/catch.hpp>

#include "tests/check/law.h"

using namespace trunnion;

namespace {

const std::string head = "O8\nG21G90G17G94G54F200.S500M3\n";

std::optional<check::Finding> finding(const law::Outcome& out, const std::string& rule) {
    for (const check::Finding& f : out.findings)
        if (f.rule == rule) return f;
    return std::nullopt;
}

bool notes_contain(const law::Outcome& out, const std::string& text) {
    for (const std::string& note : out.run.notes)
        if (note.find(text) != note.npos) return true;
    return false;
}

}  // namespace

TEST_CASE("an alarm that a known jump passes over is only a note", "[check]") {
    const std::string block =
        GENERATE("#2=SQRT[-1]", "#2=1/0", "X[1/0]", "#2=ASIN[2]", "G10L2P99X1.");
    const std::string before = GENERATE("#1=5\nIF[#1GT0]GOTO10\n", "GOTO10\n", "#1=10\nGOTO#1\n",
                                        "#1=0\nIF[#1EQ0]THEN#2=1\nIF[#2EQ1]GOTO10\n");
    const law::Outcome out = law::judge(head + before + block + "\nN10X1.\nM30\n");
    INFO(before << block);
    CHECK_FALSE(out.run.alarm);
    for (const check::Finding& f : out.findings)
        if (f.rule == "alarm") CHECK(f.severity == check::Severity::note);
}

TEST_CASE("an alarm behind an unknown condition is a warning, behind none an error", "[check]") {
    const auto severity = [](const std::string& lines) {
        const auto found = finding(law::judge(head + lines + "\nN10X1.\nM30\n"), "alarm");
        REQUIRE(found);
        const bool certain = found->text.find("if it reaches this block") == std::string::npos;
        CHECK(certain == (found->severity == check::Severity::error));
        return found->severity;
    };
    CHECK(severity("IF[#500GT0]GOTO10\n#2=SQRT[-1]") == check::Severity::warning);
    CHECK(severity("IF[#500GT0]THEN\n#2=1/0\nENDIF") == check::Severity::warning);
    CHECK(severity("WHILE[#500GT0]DO1\n#2=1/0\nEND1") == check::Severity::warning);
    CHECK(severity("M30\nN5#2=1/0") == check::Severity::note);
    CHECK(severity("IF[1/0GT#500]GOTO10") == check::Severity::error);
    CHECK(severity("G31X5.\n#2=1/0") == check::Severity::error);
    CHECK(severity("G65P20A1.\n#2=1/0\nM30\nO20\nG91X1.\nM99\nO21") == check::Severity::error);
    CHECK(severity("M98P20\n#2=1/0\nM30\nO20\nM30") == check::Severity::warning);
    CHECK(severity("M98P20\n#2=1/0\nM30\nO20\nM99P10") == check::Severity::warning);
    CHECK(severity("#2=1/0") == check::Severity::error);
}

TEST_CASE("check follows loops that known values end", "[check]") {
    const law::Outcome out =
        law::judge(head + "#1=0\nN5#1=#1+1\nG91X1.\nIF[#1LT3]GOTO5\n#2=1/[#1-3]\nM30\n");
    REQUIRE(out.run.alarm);
    CHECK(out.refused_by_check(out.run.alarm->where.line));
    const law::Outcome endless = law::judge(head + "N5X1.\nX2.\nGOTO5\n#2=1/0\nM30\n");
    CHECK_FALSE(endless.refused_by_check());
}

TEST_CASE("a program that does not end is told by run and check", "[check]") {
    const law::Outcome open = law::judge(head + "X1.\n");
    CHECK(notes_contain(open, "END OF RECORD"));
    REQUIRE(finding(open, "program-end"));
    CHECK(finding(open, "program-end")->severity == check::Severity::warning);
    const law::Outcome again = law::judge(head + "X1.\nM99\n");
    CHECK(notes_contain(again, "M99 in the main program"));
    REQUIRE(finding(again, "program-end"));
    CHECK(finding(again, "program-end")->severity == check::Severity::note);
    CHECK_FALSE(finding(law::judge(head + "X1.\nM98P20\nM30\nO20\nM99\n"), "program-end"));
    CHECK_FALSE(finding(law::judge("O9020\nX1.\nM99\n"), "program-end"));
    CHECK_FALSE(finding(law::judge(head + "N5X1.\nGOTO5\n"), "program-end"));
    CHECK(finding(law::judge(head + "M98P20\nM30\nO20\nX1.\n"), "program-end"));
}

TEST_CASE("G10 with M99 is refused by both", "[check]") {
    const law::Outcome out = law::judge(head + "G10L2P1M99\n");
    CHECK(out.run.alarm.has_value() == out.refused_by_check());
}

TEST_CASE("a program with M99 is also read as a main program, in notes", "[check]") {
    const law::Outcome out = law::judge("O8\nG21G90G17G94G54\nG43H99Z5.\nG1X1.\nM99\n");
    REQUIRE(out.run.alarm);
    CHECK_FALSE(out.refused_by_check());
    REQUIRE(finding(out, "alarm"));
    CHECK(finding(out, "alarm")->line == out.run.alarm->where.line);
    CHECK(finding(out, "alarm")->severity == check::Severity::note);
    CHECK(finding(out, "offset"));
    CHECK_FALSE(finding(law::judge("O9008\nG1X1.\nM99\n"), "alarm"));
}

TEST_CASE("small letters are told once, those of comments, names and prints not", "[check]") {
    const law::Outcome out = law::judge("O8(text)\ng21g90\nx1.\nm30\n");
    CHECK(notes_contain(out, "small letters"));
    REQUIRE(finding(out, "lower-case"));
    CHECK(finding(out, "lower-case")->line == 2);
    const law::Outcome good = law::judge("O8(text)\nPOPEN\nDPRNT[Text]\nPCLOS\nM30(end)\n");
    CHECK_FALSE(notes_contain(good, "small letters"));
    CHECK_FALSE(finding(good, "lower-case"));
}

TEST_CASE("an arc that is not closed is told alike by run and check", "[check]") {
    const std::string arc = GENERATE("G2X20.Y0.I6.J0.", "G18G2X20.Z0.I6.K0.", "G41D1\nG2X20.I6.");
    const law::Outcome out = law::judge(head + "G0X0.Y0.Z0.\nG1X10.\n" + arc + "\nG40\nM30\n");
    INFO(arc);
    CHECK_FALSE(out.run.alarm);
    CHECK(notes_contain(out, "off the circle"));
    REQUIRE(finding(out, "arc-radius"));
    CHECK(finding(out, "arc-radius")->severity == check::Severity::warning);
}

TEST_CASE("an arc without R and centre is told alike by run and check", "[check]") {
    const std::string arc = GENERATE("G2X20.Y5.F9.", "G41D0\nG1X5.\nG2X20.Y5.");
    const law::Outcome out = law::judge(head + arc + "\nG40\nM30\n");
    CHECK(notes_contain(out, "a straight line"));
    CHECK(finding(out, "arc-radius"));
}

TEST_CASE("an offset that nothing sets is told, one that the program sets is not", "[check]") {
    const std::string use = GENERATE("G43H99Z50.", "G43H99", "G43H1Z5.\nG0X1.\nH99", "G41D99X1.",
                                     "G41D99", "G43Z50.", "G41X1.");
    const law::Outcome out = law::judge(head + use + "\nG40G49\nM30\n");
    INFO(use);
    CHECK(finding(out, "offset"));
    CHECK((notes_contain(out, "99 (line ") || notes_contain(out, " so far: ")));
    for (const std::string set : {"G10L10P1R0.\nG10L10P99R0.\nG10L12P99R0.\n",
                                  "#11001=0\n#11099=0\n#13099=0\n#2299=1.\n"}) {
        if (use.find("99") == use.npos) continue;
        CHECK_FALSE(finding(law::judge(head + set + use + "\nG40G49\nM30\n"), "offset"));
    }
    CHECK_FALSE(finding(law::judge(head + "G43H0Z5.\nG41D0X1.\nG40\nM30\n"), "offset"));
}

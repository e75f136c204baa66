// Programs that stop: by an alarm, by a limit, by the same alarm on both sides.
#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "tests/regression/programs.h"

using namespace trunnion;
using namespace trunnion::testing;
using regression::CompareStatus;

namespace {

const std::string part =
    "O1\nG90 G21 G94 G54\nT1 M6\nS500 M3\nG0 X0. Y0. Z200.\nG1 X9. F300.\nY5.\nX20.\nM30\n";
const setup::Setup& machine() {
    static const setup::Setup setup = bc_table();
    return setup;
}

}  // namespace

TEST_CASE("a side that stops with an alarm shows the block of the cause", "[compare]") {
    const auto stops = [](const std::string& b) { return compare_texts(part, b, machine()); };
    SECTION("the block itself") {
        const regression::Comparison r = stops(replaced(part, "Y5.", "Y5000."));
        CHECK(r.status == CompareStatus::alarm);
        CHECK(r.alarm_a.empty());
        CHECK(r.alarm_b.starts_with("OT0500 "));
        CHECK(r.differences.front().b.line == 7);
        CHECK(r.differences.front().cause == "Y5000. instead of Y5.");
    }
    SECTION("a block before it") {
        const regression::Comparison r =
            stops(replaced(part, "G90 G21 G94 G54\nT1 M6", "G90 G21 G94 G54\n#1=0\nT1 M6\nG65"));
        CHECK(r.status == CompareStatus::alarm);
        CHECK(r.differences.front().what.find("B stops with alarm") == 0);
    }
    SECTION("the sides exchanged") {
        const regression::Comparison r =
            compare_texts(replaced(part, "Y5.", "Y5000."), part, machine());
        CHECK(r.status == CompareStatus::alarm);
        CHECK(r.alarm_b.empty());
        CHECK(r.differences.front().what.find("A stops with alarm OT0500") == 0);
        CHECK(r.differences.front().a.line == 7);
    }
    SECTION("each side with an alarm of its own") {
        const regression::Comparison r = compare_texts(
            replaced(part, "Y5.", "Y5000."), replaced(part, "X20.", "#3000=7(OFF)"), machine());
        CHECK(r.status == CompareStatus::alarm);
        CHECK_FALSE(r.alarm_a.empty());
        CHECK_FALSE(r.alarm_b.empty());
        CHECK(r.alarm_a != r.alarm_b);
        CHECK(r.differences[0].what.find("A stops") == 0);
        CHECK(r.differences[1].what.find("B stops") == 0);
    }
    SECTION("of the words alone it is no difference, but said") {
        const std::string both = replaced(part, "Y5.", "Y5000.");
        const regression::Comparison r =
            compare_texts(both, replaced(both, "X20.", "X21."), machine());
        CHECK(r.by == regression::Layer::words);
        CHECK(r.status == CompareStatus::differs);
        CHECK(r.alarm_a == r.alarm_b);
        CHECK(r.notes.front().find("both stop with alarm OT0500") == 0);
    }
}

TEST_CASE("a limit of blocks, or an end from outside, is no verdict on the rest", "[compare]") {
    const std::string b = replaced(part, "X20.", "X21.");
    regression::CompareOptions options;
    options.max_blocks = 6;
    const regression::Comparison r = compare_texts(part, b, machine(), options);
    CHECK(r.status == CompareStatus::limit);
    CHECK_FALSE(r.equal);
    CHECK(r.notes.back().find("what follows the limit") != std::string::npos);
    options.max_blocks = 0;
    options.go_on = [] { return false; };
    CHECK(compare_texts(part, b, machine(), options).status == CompareStatus::limit);
    // An alarm on the other side is graver.
    options = {};
    options.max_blocks = 7;
    const std::string stops = replaced(part, "G1 X9.", "G1 X9000.");
    CHECK(compare_texts(stops, b, machine(), options).status == CompareStatus::alarm);
    CHECK(compare_texts(b, stops, machine(), options).status == CompareStatus::alarm);
}

TEST_CASE("numbers without a point: equal only if they are with least increments too",
          "[compare]") {
    // The second writes the same end in steps.
    const std::string a = replaced(part, "Y5.", "Y5");
    const regression::Comparison same =
        compare_texts(a, replaced(a, "Y5\n", "G91 Y5\nG90\n"), machine());
    INFO(same.verdict);
    CHECK(same.equal);
    const regression::Comparison mixed = compare_texts(a, part, machine());
    INFO(mixed.verdict);
    CHECK_FALSE(mixed.equal);
    CHECK(mixed.differences.back().what.find("numbers without a decimal point") == 0);
    // With increments both stop at the arc, so nobody runs them like this.
    const std::string arc = replaced(part, "X20.", "G2 X20. R10");
    const regression::Comparison nobody =
        compare_texts(arc, replaced(arc, "Y5.", "G91 Y5.\nG90"), machine());
    INFO(nobody.verdict);
    CHECK(nobody.equal);
    // Where the parameter is given, it decides.
    setup::Setup given = machine();
    given.stores.parameters.set(3401, 0);
    CHECK_FALSE(compare_texts(a, part, given).equal);
    given.stores.parameters.set(3401, 1);
    CHECK(compare_texts(a, part, given).equal);
}

TEST_CASE("programs that move nothing are compared by what they leave", "[compare]") {
    const std::string a = "O1\n#500=1.\nG10 L2 P3 X5.\nM8\nM30\n";
    CHECK(compare_texts(a, replaced(a, "#500=1.", "#500=[2.-1.]"), machine()).equal);
    const regression::Comparison value =
        compare_texts(a, replaced(a, "#500=1.", "#500=2."), machine());
    CHECK_FALSE(value.equal);
    CHECK(value.by == regression::Layer::effects);
    const regression::Comparison code = compare_texts(a, replaced(a, "M8", "M7"), machine());
    CHECK_FALSE(code.equal);
}

TEST_CASE("a comment that is not closed stops a program: it is never equal to one without",
          "[compare]") {
    for (const char* open : {"N10 (OPEN\nX20.", "(OPEN\nX20.", "X20. (OPEN"}) {
        INFO(open);
        const regression::Comparison r =
            compare_texts(part, replaced(part, "X20.", open), machine());
        CHECK(r.status == CompareStatus::alarm);
        CHECK_FALSE(r.equal);
        CHECK(r.alarm_b.starts_with("PS0009 "));
    }
}

TEST_CASE("a program that moves against one that does not", "[compare]") {
    const std::string none = "O1\nG90 G21 G94 G54\nT1 M6\nS500 M3\nM30\n";
    for (const bool moves_in_a : {true, false}) {
        const regression::Comparison r =
            compare_texts(moves_in_a ? part : none, moves_in_a ? none : part, machine());
        INFO(r.verdict);
        CHECK(r.status == CompareStatus::differs);
        CHECK(r.by == regression::Layer::path);
        CHECK(r.differences.front().kind == (moves_in_a ? regression::DifferenceKind::only_a
                                                        : regression::DifferenceKind::only_b));
    }
}

TEST_CASE("an alarm in the call of both programs is told at the call", "[compare]") {
    regression::CompareOptions options;
    options.call = "G65 P1 Z[1";
    const regression::Comparison r =
        compare_texts(part, replaced(part, "X20.", "X21."), machine(), options);
    CHECK_FALSE(r.equal);
    CHECK(r.by == regression::Layer::words);
    CHECK(r.alarm_a == r.alarm_b);
    // Of one side alone: the argument that it asks for.
    options.call = "G65 P1 A1.";
    const std::string asks = replaced(part, "G90 G21", "IF[#1EQ1.]THEN#3000=7(NO)\nG90 G21");
    const regression::Comparison one = compare_texts(part, asks, machine(), options);
    CHECK(one.status == CompareStatus::alarm);
    CHECK(one.alarm_b.starts_with("MC3007 "));
    CHECK(one.differences.front().b.line == 2);
}

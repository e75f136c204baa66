// What an earlier program or an operator left in the control: G52, G92, variables, offsets. The log
// is that of a program that sets it in its first block; the program that is judged does not.
#include "choices/inherited_variables.h"
#include "choices/offset_words.h"
#include "tests/choices/sampled_log.h"

namespace trunnion {

using choices::GapCause;
using choices::GapVerdict;
using log_bench::gap_of;
using log_bench::log_of;
using log_bench::mill_of;

namespace {

constexpr const char* tools =
    "work_offsets.G54 = { X = 12.5, Y = -8, Z = 3 }\nwork_offsets.G55 = { X = 60, Y = 5 }\n"
    "tools.1 = { length_mm = 99, diameter_mm = 10 }\n";

/// Two work offsets, so that no single one of them shifts all.
const std::string part = R"(N10 G90 G21 G17 G54
N20 G43 H1 Z50.
N30 G0 X4. Y3.
N40 G1 Z2. F500.
N50 X40. Y10.
N60 G2 X60. Y30. R30.
N70 G0 Z30.
N80 G55 X5. Y5.
N90 G1 Z1. F200.
N100 X25.
N110 Y-10.
N120 G0 Z40.
N130 G54 X1. Y2.
N140 M30
)";

std::string changed(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
}

/// The log of a program with other words in its first block.
choices::ControlGap judged(const std::string& program, const std::string& first) {
    const auto here = mill_of(tools);
    return gap_of(here, log_of(here, changed(program, "N10 G90", "N10 " + first + " G90")),
                  program);
}

std::set<std::string> named(const GapCause& cause) {
    std::set<std::string> out{cause.name};
    out.insert(cause.rivals.begin(), cause.rivals.end());
    return out;
}

}  // namespace

TEST_CASE("a shift of all offsets is an external offset, a G52 or G92 left in force, or a zero") {
    std::string own = changed(part, "N10 G90 G21 G17 G54", "N10 G90");
    std::set<std::string> all{"external", "G52", "G92"};
    for (const bool tells : {true, false}) {
        // Before its first move an axis stands where another zero would not be.
        INFO("the start tells a zero " << tells);
        if (!tells) own = changed(own, "H1 Z50.", "H1 X2. Y1. Z50.");
        if (!tells) all.insert("machine zero");
        for (const char* first : {"G52 X0.7 Y-0.2\nN15", "G92 X-0.7 Y0.3\nN15"}) {
            INFO(first);
            const auto gap = judged(own, first);
            REQUIRE(gap.causes.size() == 1);
            CHECK(named(gap.causes[0]) == all);
            CHECK(gap.causes[0].probability < 0.34);
            CHECK(gap.verdict == GapVerdict::ambiguous);
        }
    }
}

TEST_CASE("a program that visits the machine's zero tells an offset from another zero") {
    const std::string home = changed(part, "N120 G0 Z40.", "N120 G53 Z100.");
    const auto gap = judged(home, "G52 X0.7 Z-0.2\nN15");
    REQUIRE(gap.causes.size() == 1);
    CHECK(named(gap.causes[0]) == std::set<std::string>{"external", "G52", "G92"});
}

TEST_CASE("a G52 left in force is named where the program has its own") {
    const std::string own = changed(part, "N110 Y-10.",
                                    "N103 G52 X3.\nN105 X20. Y3.\nN107 G52 X0. "
                                    "Y0. Z0.\nN110 Y-10.");
    const auto gap = judged(own, "G52 X0.7 Y-0.2\nN15");
    REQUIRE(gap.causes.size() == 1);
    CHECK(gap.causes[0].name == "G52");
    CHECK(gap.causes[0].probability > 0.7);
    REQUIRE(gap.causes[0].numbers.size() == 2);
    CHECK(gap.causes[0].numbers[0].to == Approx(0.7).margin(1e-4));
    CHECK(gap.setup.stores.work.local[Axis::X] == Approx(0.7).margin(1e-4));
    std::vector<std::string> notes;
    const auto again = setup::parse_setup(setup::format_setup(gap.setup), "s.toml", notes);
    const auto here = mill_of(tools);
    CHECK(gap_of(again, log_of(here, changed(own, "N10 G90", "N10 G52 X0.7 Y-0.2\nN15 G90")), own)
              .verdict == GapVerdict::no_gap);
}

TEST_CASE("a stale common variable is named with its value, or is a rival of what does as much") {
    const std::string reads = changed(part, "N80 G55 X5. Y5.", "N80 G55 X[5.+#500] Y5.");
    const auto with = [](const std::string& variables) {
        return mill_of(std::string(tools) + "[control.variables]\n" + variables);
    };
    const auto log = log_of(with("500 = 2.25\n"), reads);
    for (const char* here : {"500 = 0.0\n", "500 = 2.249\n", "500 = -150.0\n", ""}) {
        INFO(here);
        const auto gap = gap_of(with(here), log, reads);
        REQUIRE(gap.causes.size() == 1);
        CHECK(named(gap.causes[0]).contains("common variables"));
        if (gap.causes[0].name == "common variables") {
            CHECK(gap.causes[0].numbers[0].name == "#500");
            CHECK(gap.causes[0].numbers[0].to == Approx(2.25).margin(2e-4));
        }
        CHECK((gap.verdict == GapVerdict::explained || gap.verdict == GapVerdict::ambiguous));
    }
    const std::string sets = changed(part, "N20 G43", "N15 G10 L2 P0 X#501 Y#502\nN20 G43");
    const auto gap = gap_of(mill_of(tools), log_of(with("501 = 1.5\n502 = -2.0\n"), sets), sets);
    std::set<std::string> all;
    for (const GapCause& cause : gap.causes) all.merge(named(cause));
    CHECK(all.contains("common variables"));
    CHECK(gap.verdict == GapVerdict::ambiguous);
}

TEST_CASE("an empty G54.1 that the program calls may be the other control's") {
    const std::string more = changed(part, "N80 G55", "N80 G54.1 P3");
    const auto there = mill_of(std::string(tools) + "work_offsets.\"G54.1 P3\" = { X = 0.7 }\n");
    const auto gap = gap_of(mill_of(tools), log_of(there, more), more);
    REQUIRE(gap.causes.size() == 1);
    CHECK(gap.causes[0].name == "G54.1P3");
    CHECK(gap.causes[0].numbers[0].to == Approx(0.7).margin(1e-4));
}

TEST_CASE("variables and offsets that a program takes over are found in its text") {
    using choices::additional_offsets;
    using choices::inherited_variables;
    const auto of = [](const std::string& text) {
        return inherited_variables({log_bench::program_of(text)});
    };
    CHECK(of("X#500 (Y#501)\nZ[#502+1]\n") == std::set<int>{500, 502});
    CHECK(of("#500=1.\nX#500\n#101=#101+1\n") == std::set<int>{101});
    CHECK(of("IF[#100EQ#0]THEN #100=3.\nX#1 Y#5041\n") == std::set<int>{100});
    CHECK(of("#500 = 3\nG0 X#500\n").empty());
    CHECK(additional_offsets({log_bench::program_of(
              "G54.1 P3\nG54P12X1.\nM98 P5\nG10L20P7X1\n")}) == std::set<int>{3, 7, 12});
}

}  // namespace trunnion

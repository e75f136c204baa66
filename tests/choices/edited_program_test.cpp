// The program that ran was edited: an edit of one block is told, and no store is sure beside it.
#include "tests/choices/sampled_log.h"

namespace trunnion {

using choices::GapCause;
using choices::GapVerdict;
using log_bench::gap_of;
using log_bench::has_note;
using log_bench::log_of;
using log_bench::mill_of;

namespace {

constexpr const char* tools =
    "work_offsets.G54 = { X = 12.5, Y = -8.0, Z = 3.25 }\n"
    "tools.1 = { length_mm = 150, diameter_mm = 10 }\n";

const std::string origin = R"(N10 G21 G90 G17 G54
N20 G43 H1 Z50.
N30 G10 L2 P2 X35. Y-21. Z-4.
N40 G55
N50 G0 X10. Y10. Z30.
N60 G1 Z-2. F600
N70 X60.
N80 Y40.
N90 X10. Y12.
N100 G0 Z30.
N110 M30
)";

const std::string side = R"(N10 G21 G90 G17 G54
N20 G0 X-30. Y-30. Z2.
N30 G41 D1 G1 X0. Y-8. F400
N40 Y30.
N50 X30.
N60 Y0.
N70 X-8.
N80 G40 X-30. Y-20.
N90 G0 Z30.
N100 M30
)";

const std::string mill = R"(N10 G21 G90 G17 G54
N20 G0 X10. Y10. Z30.
N30 G1 Z-2. F600
N40 X60. Y3.
N50 Y40.
N60 X10. Y12.
N70 G0 Z30.
N80 X5. Y1.
N90 M30
)";

std::string edited(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
}

bool has_rival(const GapCause& cause, const std::string& words) {
    return std::any_of(cause.rivals.begin(), cause.rivals.end(), [&](const std::string& rival) {
        return rival.find(words) != std::string::npos;
    });
}

}  // namespace

TEST_CASE("an offset that the program sets itself may have been edited: no store is sure") {
    const auto here = mill_of(tools);
    const auto gap = gap_of(here, log_of(here, edited(origin, "X35.", "X35.2")), origin);
    REQUIRE(gap.causes.size() == 1);
    CHECK(gap.causes[0].name == "external");
    CHECK(gap.causes[0].probability < 0.5);
    CHECK(has_rival(gap.causes[0], "line 3 reads X35.2"));
    CHECK(gap.verdict == GapVerdict::ambiguous);
}

TEST_CASE("the other side of the contour is no negative radius") {
    const auto here = mill_of(tools);
    const auto gap = gap_of(here, log_of(here, edited(side, "G41", "G42")), side);
    for (const GapCause& cause : gap.causes) {
        if (!cause.known) continue;
        CHECK(cause.probability <= 0.5);
        CHECK(has_rival(cause, "line 3 reads G42"));
    }
}

TEST_CASE("another D is no other radius of the tool") {
    const auto here =
        mill_of(std::string(tools) + "tools.2 = { length_mm = 99, diameter_mm = 6 }\n");
    const auto gap = gap_of(here, log_of(here, edited(side, "D1", "D2")), side);
    REQUIRE(!gap.causes.empty());
    CHECK(gap.causes[0].name == "D1");
    CHECK(gap.causes[0].probability < 0.5);
    CHECK(has_rival(gap.causes[0], "line 3 reads D2"));
    CHECK(gap.setup.stores.tools.tool[1].radius_mm() == Approx(5.0));
}

TEST_CASE("an edited number is no cause, and a note tells where it is") {
    const auto here = mill_of(tools);
    const auto gap = gap_of(here, log_of(here, edited(mill, "Y40.", "Y40.35")), mill);
    CHECK(gap.verdict == GapVerdict::unexplained);
    CHECK(has_note(gap, "line 5 reads Y40.35"));
    const auto less = gap_of(here, log_of(here, edited(mill, "N50 Y40.\n", "N50\n")), mill);
    CHECK(has_note(less, "line 5 is left out"));
}

TEST_CASE("a stale offset is as sure as before where no edit of one block does the same") {
    const auto here = mill_of(tools);
    const auto there = mill_of(edited(tools, "X = 12.5", "X = 12.55"));
    const auto unseen = gap_of(here, log_of(there, origin), origin);
    CHECK(unseen.verdict == GapVerdict::no_gap);
    const auto other = gap_of(here, log_of(there, mill), mill);
    REQUIRE(other.causes.size() == 1);
    CHECK(other.causes[0].rivals ==
          std::vector<std::string>{"external", "G52", "G92", "machine zero"});
}

}  // namespace trunnion

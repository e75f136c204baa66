// A control that reads ahead under G41 tells the block that it has read, and starts its offset
// otherwise than this one.
#include "tests/choices/sampled_log.h"

namespace trunnion {

using log_bench::gap_of;
using log_bench::has_note;
using log_bench::mill_of;

namespace {

const std::string contour = R"(N10 G90 G21 G17 G54
N20 G0 X-4. Y-20.
N30 G1 Z1. F300.
N40 G41 D1 X0. Y-10.
N50 Y30.
N60 X40.
N70 Y0.
N80 X-10.
N90 G40 X-25. Y-15.
N100 G0 Z30.
N110 M30
)";
const std::string tool = "[control.tools]\n1 = { length_mm = 0, diameter_mm = 8 }\n";
const std::string stale = "[control.tools]\n1 = { length_mm = 0, diameter_mm = 8.1 }\n";

records::PositionLog read_ahead() {
    records::PositionLog log = log_bench::log_of(mill_of(tool), contour);
    for (records::LoggedPosition& row : log.rows)
        if (row.block >= 4 && row.block < 9) ++row.block;
    for (records::LoggedPosition& row : log.rows)
        if (row.block == 5) row.at[Axis::Y] += 0.77;
    return log;
}

}  // namespace

TEST_CASE("numbers read ahead: the block with another start is told, not all of the contour") {
    const auto gap = gap_of(mill_of(tool), read_ahead(), contour);
    CHECK(has_note(gap, "the positions agree in their order"));
    CHECK(gap.verdict == choices::GapVerdict::unexplained);
    CHECK(gap.worst.apart < 1.0);
    CHECK(gap.worst.line == 4);
    const auto radius = gap_of(mill_of(stale), read_ahead(), contour);
    REQUIRE(!radius.causes.empty());
    CHECK(radius.causes[0].name == "D1");
    CHECK(radius.worst.apart < 1.0);
}

}  // namespace trunnion

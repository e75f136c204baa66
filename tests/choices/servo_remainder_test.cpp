// Logs of actual positions: what backlash leaves beside a cause of the control is no part of it.
#include "tests/choices/sampled_log.h"

namespace trunnion {

using choices::GapVerdict;
using log_bench::gap_of;
using log_bench::mill_of;
using log_bench::SampledLog;

namespace {

const std::string pocket = R"(N10 G21 G90 G17 G54
N20 G0 X10. Y10. Z30.
N30 G1 Z-2. F600
N40 X58 Y12.
N50 Y40.
N60 Z-4.
N70 X10.
N80 Y10.
N90 X40. Y30.
N100 X20 Y35.
N110 G0 Z30.
N120 M30
)";

/// The pocket with another length of its words without a point, and another G54.X.
records::PositionLog pocket_log(double a_word, double shift) {
    SampledLog log({0, 0, 0});
    const double cut = 0.25;
    const auto to = [&](int block, double x, double y, double z, double step) {
        log.to(block, {x + shift, y, z}, step);
    };
    to(20, 10, 10, 30, 2.0);
    to(30, 10, 10, -2, cut);
    to(40, 58 * a_word, 12, -2, cut);
    to(50, 58 * a_word, 40, -2, cut);
    to(60, 58 * a_word, 40, -4, cut);
    to(70, 10, 40, -4, cut);
    to(80, 10, 10, -4, cut);
    to(90, 40, 30, -4, cut);
    to(100, 20 * a_word, 35, -4, cut);
    to(110, 20 * a_word, 35, 30, 2.0);
    return log.log;
}

/// As a scale on each axis reads it: half the play to either side.
records::PositionLog with_backlash(records::PositionLog log, double play_mm) {
    const records::PositionLog ideal = log;
    AxisPositions side;
    for (std::size_t i = 1; i < log.rows.size(); ++i)
        for (const Axis axis : log.axes) {
            const double way = ideal.rows[i].at[axis] - ideal.rows[i - 1].at[axis];
            if (way != 0.0) side[axis] = way > 0.0 ? -0.5 * play_mm : 0.5 * play_mm;
            log.rows[i].at[axis] += side[axis];
        }
    return log;
}

/// Each axis too long by a part of its way.
records::PositionLog with_scale(records::PositionLog log, double part) {
    for (records::LoggedPosition& row : log.rows)
        for (const Axis axis : log.axes) row.at[axis] *= 1.0 + part;
    return log;
}

}  // namespace

TEST_CASE("backlash in a log of actual positions does not make an option unsure") {
    const auto log = with_backlash(pocket_log(0.001, 0.0), 0.012);
    const auto gap = gap_of(mill_of("[control.parameters]\n3401 = \"00000001\"\n"), log, pocket);
    CHECK(gap.verdict == GapVerdict::partly_explained);
    REQUIRE(gap.causes.size() > 1);
    CHECK(gap.causes[0].name == "3401#0=0");
    CHECK(gap.causes[0].probability > 0.7);
    // Unknown is what stays, and where.
    CHECK(!gap.causes.back().known);
    CHECK(gap.causes.back().share < 0.01);
    CHECK(gap.causes.back().worst.apart < 0.02);
}

TEST_CASE("backlash in a log of actual positions does not make a store unsure") {
    const auto log = with_backlash(pocket_log(1.0, 0.25), 0.012);
    const auto gap = gap_of(mill_of("[control.parameters]\n3401 = \"00000001\"\n"), log, pocket);
    CHECK(gap.verdict == GapVerdict::partly_explained);
    REQUIRE(!gap.causes.empty());
    CHECK(gap.causes[0].name == "G54");
    CHECK(choices::is_claimed(gap.causes[0]));
    REQUIRE(!gap.causes[0].numbers.empty());
    CHECK(std::abs(gap.causes[0].numbers[0].to - 0.25) < 0.01);
}

TEST_CASE("an error of a machine is no store, and the gap is unknown as a whole") {
    const auto log = with_scale(pocket_log(1.0, 0.0), 0.002);
    const auto gap = gap_of(mill_of("[control.parameters]\n3401 = \"00000001\"\n"), log, pocket);
    CHECK(gap.verdict == GapVerdict::unexplained);
    REQUIRE(!gap.causes.empty());
    CHECK(gap.causes.back().share == 1.0);
    for (const choices::GapCause& cause : gap.causes) CHECK(!(cause.known && is_claimed(cause)));
}

}  // namespace trunnion

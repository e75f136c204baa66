// A log that ends within the program: the other control stopped, or the log was cut off.
#include "tests/choices/sampled_log.h"

namespace trunnion {

using choices::ControlGap;
using choices::GapVerdict;
using log_bench::gap_of;
using log_bench::mill_of;
using log_bench::SampledLog;

namespace {

const std::string part = R"(N10 G90 G21 G17 G54
N20 G0 X5. Y6. Z50.
N30 G1 Z2. F300.
N40 X25.
N50 Y20.
N60 X30. Y25.
N70 G0 Z50.
N80 X0. Y0.
N90 M30
)";

/// Up to N50, and `rest` rows more there; or without its last rows.
records::PositionLog samples(std::size_t rest, std::size_t without) {
    SampledLog log({0, 0, 0});
    log.to(20, {5, 6, 50}, 3.0);
    log.to(30, {5, 6, 2}, 0.31);
    log.to(40, {25, 6, 2}, 0.31);
    log.to(50, {25, 20, 2}, 0.31);
    for (std::size_t k = 0; k < rest; ++k) log.add(50, {25, 20, 2});
    log.log.rows.resize(log.log.rows.size() - without);
    return log.log;
}

}  // namespace

TEST_CASE("a control that stopped within the program is no agreement") {
    for (const auto& log : {samples(10, 0), samples(1, 0)}) {
        const ControlGap gap = gap_of(mill_of(), log, part);
        CHECK(gap.verdict == GapVerdict::unexplained);
        REQUIRE(gap.causes.size() == 1);
        CHECK(gap.causes[0].name == "unknown");
        CHECK(gap.causes[0].probability < 0.7);
        CHECK(gap.ends_before.line == 6);
        CHECK(gap.stands_there);
    }
    auto within = samples(0, 7);  // a rest within a block, as a file of it is read
    within.rows.back().repeated = 9;
    CHECK(gap_of(mill_of(), within, part).verdict == GapVerdict::unexplained);
    auto trace = log_bench::log_of(mill_of(), part);
    CHECK(gap_of(mill_of(), trace, part).verdict == GapVerdict::no_gap);
    trace.rows.resize(4);
    const ControlGap gap = gap_of(mill_of(), trace, part);
    CHECK(gap.verdict == GapVerdict::unexplained);
    CHECK(gap.ends_before.line == 6);
}

TEST_CASE("a log that ends in motion was cut off") {
    const ControlGap gap = gap_of(mill_of(), samples(0, 7), part);
    CHECK(gap.verdict == GapVerdict::no_gap);
    CHECK(gap.ends_before.line == 5);
    CHECK(!gap.stands_there);
}

TEST_CASE("an option with which this control stops where the log ends is the cause") {
    const std::string arc = R"(N10 G90 G21 G17 G54
N20 G0 X5. Y6. Z50.
N30 G1 Z2. F300.
N40 X25.
N50 G2 X30. Y10.
N60 G1 X35. Y25.
N70 G0 Z50.
N80 M30
)";
    const auto there = mill_of("[control.parameters]\n3403 = \"00100000\"\n"),
               here = mill_of("[control.parameters]\n3403 = \"00000000\"\n");
    const ControlGap gap = gap_of(here, log_bench::log_of(there, arc), arc);
    CHECK(gap.verdict == GapVerdict::ambiguous);
    REQUIRE(gap.causes.size() == 1);
    CHECK(gap.causes[0].name == "3403#5=1");
    CHECK(gap.causes[0].probability < 0.5);
    CHECK(gap.causes[0].rivals.front() == "a log that was cut off");
}

TEST_CASE("stores beside a control that stopped are told, and it is not explained by them") {
    const auto there = mill_of("[control.work_offsets]\nG54 = { X = 0.3, Y = 0.2 }\n");
    auto trace = log_bench::log_of(there, part);
    trace.rows.resize(5);
    const ControlGap gap = gap_of(mill_of(), trace, part);
    CHECK(gap.verdict == GapVerdict::partly_explained);
    CHECK(!gap.causes.back().known);
    CHECK(gap.ends_before.line == 7);
}

}  // namespace trunnion

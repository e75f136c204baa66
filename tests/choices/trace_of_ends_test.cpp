// A log that does not tell ends of moves from samples: rows that stand on ends are ends.
#include "tests/choices/sampled_log.h"

namespace trunnion {

using choices::GapVerdict;
using log_bench::gap_of;
using log_bench::has_note;
using log_bench::mill_of;
using log_bench::SampledLog;

namespace {

const std::string drilled = R"(N10 G90 G21 G17 G54
N20 G0 X0. Y0. Z50.
N30 G99 G73 X10. Y10. Z-9. R3. Q4. F200.
N40 X25.
N50 Y30.
N60 G80
N70 G0 Z40.
N80 X0. Y0.
N90 G1 X20. Y5. F800.
N100 Z10.
N110 M30
)";
constexpr const char* taken = "all are taken as ends of moves";

/// A trace without the column that tells what its rows are.
records::PositionLog bare_trace(const setup::Setup& there) {
    records::PositionLog log = log_bench::log_of(there, drilled);
    log.ends = false;
    for (records::LoggedPosition& row : log.rows) row.end = false;
    log.step = 1e-4;
    return log;
}

}  // namespace

TEST_CASE("rows on ends of moves are ends, also without a column that says so") {
    const auto here = mill_of("[control.parameters]\n5114 = 2.0\n");
    const auto same = gap_of(here, bare_trace(here), drilled);
    CHECK(same.verdict == GapVerdict::no_gap);
    CHECK(has_note(same, taken));
    // Beside another offset, too.
    for (const char* offset : {"", "[control.work_offsets]\nG54 = { Y = 0.1 }\n"}) {
        const auto there = mill_of(std::string(offset) + "[control.parameters]\n5114 = 0.254\n");
        const auto gap = gap_of(here, bare_trace(there), drilled);
        CHECK(has_note(gap, taken));
        const auto retreat =
            std::find_if(gap.causes.begin(), gap.causes.end(),
                         [](const choices::GapCause& cause) { return cause.name == "5114"; });
        REQUIRE(retreat != gap.causes.end());
        CHECK(std::abs(retreat->numbers.at(0).to - 0.254) < 1e-4);
        CHECK(retreat->probability > 0.6);
    }
}

TEST_CASE("few samples a move are no ends of moves") {
    for (const double step : {7.0, 11.0, 23.0}) {
        SampledLog log({0, 0, 0});
        log.to(20, {0, 0, 50}, step);
        log.to(30, {10, 10, 50}, step);
        log.to(30, {10, 10, 3}, step);
        for (const int block : {30, 40, 50}) {
            if (block == 40) log.to(block, {25, 10, 3}, step);
            if (block == 50) log.to(block, {25, 30, 3}, step);
            const double x = log.at()[0], y = log.at()[1];
            for (const double z : {-1., 0., -5., -4., -9., 3.}) log.to(block, {x, y, z}, step);
        }
        log.to(70, {25, 30, 40}, step);
        log.to(80, {0, 0, 40}, step);
        log.to(90, {20, 5, 40}, step);
        log.to(100, {20, 5, 10}, step);
        const auto gap = gap_of(mill_of(), log.log, drilled);
        CHECK(!has_note(gap, taken));
        CHECK(gap.verdict == GapVerdict::no_gap);
    }
}

}  // namespace trunnion

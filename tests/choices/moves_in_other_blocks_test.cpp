// A choice of the control that leaves the way as it is, and makes it in other blocks.
#include "tests/choices/sampled_log.h"

namespace trunnion {

using choices::GapVerdict;
using log_bench::gap_of;
using log_bench::SampledLog;

namespace {

/// The way of Z between two stops is one stroke, whether G43 and G49 move or the block behind them.
const std::string strokes = R"(N10 G90 G21 G17 G54 G0 X0. Y0.
N30 G43 H1
N40 Z50.
N50 X20. Y10.
N60 G49
N70 Z20.
N80 X5. Y3.
N90 G43 H1
N100 Z45.
N110 X30. Y1.
N120 G49
N130 Z15.
N140 G1 X3. Y20. F500.
N150 G43 H1
N160 Z40.
N170 X8.
N180 G49
N190 Z10.
N200 M30
)";

constexpr double length = 150.0;

setup::Setup mill(bool shifts) {
    return log_bench::mill_of(
        "tools.1 = { length_mm = 150, diameter_mm = 0 }\nparameters.5006 = \"0" +
        std::string(shifts ? "1" : "0") + "000000\"\n");
}

/// By hand. `shifts`: G43 and G49 make no move.
records::PositionLog log_by(bool shifts) {
    SampledLog log({0, 0, 0});
    double x = 0.0, y = 0.0;
    const auto up = [&](int block, double z) {
        if (!shifts) log.to(block, {x, y, log.at()[2] + length}, 1.0);
        log.to(block + 10, {x, y, z + length}, 1.0);
    };
    const auto down = [&](int block, double z) {
        if (!shifts) log.to(block, {x, y, log.at()[2] - length}, 1.0);
        log.to(block + 10, {x, y, z}, 1.0);
    };
    const auto across = [&](int block, double to_x, double to_y) {
        x = to_x;
        y = to_y;
        log.to(block, {x, y, log.at()[2]}, 0.3);
    };
    log.add(10, {0, 0, 0});
    up(30, 50);
    across(50, 20, 10);
    down(60, 20);
    across(80, 5, 3);
    up(90, 45);
    across(110, 30, 1);
    down(120, 15);
    across(140, 3, 20);
    up(150, 40);
    across(170, 8, 20);
    down(180, 10);
    return log.log;
}

}  // namespace

TEST_CASE("the same way in other blocks is a choice of the control, and no wrong numbers") {
    for (const bool there : {false, true}) {
        INFO("there " << there);
        CHECK(gap_of(mill(there), log_by(there), strokes).verdict == GapVerdict::no_gap);
        const auto gap = gap_of(mill(!there), log_by(there), strokes);
        REQUIRE(!gap.causes.empty());
        CHECK(gap.causes[0].name == (there ? "5006#6=1" : "5006#6=0"));
        CHECK((gap.verdict == GapVerdict::explained || gap.verdict == GapVerdict::ambiguous));
    }
}

TEST_CASE("the same way in other blocks is seen in a log of lines, too") {
    records::PositionLog log = log_by(false);
    log.blocks = records::BlockColumn::line;
    const std::vector<int> numbers{10,  30,  40,  50,  60,  70,  80,  90,  100, 110,
                                   120, 130, 140, 150, 160, 170, 180, 190, 200};
    for (records::LoggedPosition& row : log.rows)
        row.block = static_cast<int>(std::find(numbers.begin(), numbers.end(), row.block) -
                                     numbers.begin()) +
                    1;
    const auto gap = gap_of(mill(true), log, strokes);
    REQUIRE(!gap.causes.empty());
    CHECK(gap.causes[0].name == "5006#6=0");
}

}  // namespace trunnion

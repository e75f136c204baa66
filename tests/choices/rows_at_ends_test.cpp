// A log of samples with a row at the end of each rapid: feeds may still turn between two rows.
#include "tests/choices/sampled_log.h"

namespace trunnion {

using choices::GapVerdict;
using log_bench::gap_of;
using log_bench::has_note;
using log_bench::mill_of;
using log_bench::Place;
using log_bench::SampledLog;

namespace {

const std::string holes_of_rapids = R"(N10 G90 G21 G17 G54
N20 G0 X5. Y6. Z50.
N30 X10. Y10.
N40 G99 G81 Z-9. R3. F200.
N50 X25. Y12.
N60 X14. Y30.
N70 X-8. Y21.
N80 G80
N90 G0 Z40.
N100 X1. Y2.
N110 M30
)";

/// Rapids stop at a row; feeds have even times alone, so the bottom of a hole is between two rows.
records::PositionLog log_of_rapids(double deeper_mm) {
    SampledLog log({0, 0, 0});
    const auto rapid = [&log](int block, const Place& end) {
        log.to(block, end, 4.0);
        log.add(block, end);
    };
    rapid(20, {5, 6, 50});
    rapid(30, {10, 10, 50});
    for (const auto& [block, x, y] : {std::tuple{40, 10., 10.}, std::tuple{50, 25., 12.},
                                      std::tuple{60, 14., 30.}, std::tuple{70, -8., 21.}}) {
        rapid(block, {x, y, 3});
        log.to(block, {x, y, -9 - deeper_mm}, 0.7);
        rapid(block, {x, y, 3});
    }
    rapid(90, {-8, 21, 40});
    rapid(100, {1, 2, 40});
    return log.log;
}

}  // namespace

TEST_CASE("a row at the end of every rapid does not say that feeds end at a row") {
    const auto gap = gap_of(mill_of(), log_of_rapids(0.0), holes_of_rapids);
    CHECK(!has_note(gap, "ends of moves are compared exactly"));
    CHECK(gap.verdict == GapVerdict::no_gap);
    CHECK(gap_of(mill_of(), log_of_rapids(2.0), holes_of_rapids).verdict ==
          GapVerdict::unexplained);
}

}  // namespace trunnion

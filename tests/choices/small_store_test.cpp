// Stores that differ by little more than the increment of a log, and few rows that tell which.
#include "tests/choices/sampled_log.h"

namespace trunnion {

using log_bench::gap_of;
using log_bench::log_of;
using log_bench::mill_of;

namespace {

/// Only N130, without a length, tells H1 from an offset along Z.
const std::string part = R"(N10 G90 G21 G17 G54
N20 G43 H1 Z50.
N30 G0 X4. Y3.
N40 G1 Z2. F500.
N50 X40. Y10.
N60 X60. Y30.
N70 X20. Y35.
N80 X5. Y5.
N90 Z1.
N100 X25.
N110 Y-10.
N120 G0 Z40.
N130 G49 Z180.
N140 M30
)";

setup::Setup mill(double length) {
    return mill_of("work_offsets.G54 = { X = 12.5, Y = -8, Z = 3 }\ntools.1 = { length_mm = " +
                   std::to_string(length) + ", diameter_mm = 10 }\n");
}

}  // namespace

TEST_CASE("a small length is told from an offset by the one row without a length") {
    for (const double by : {0.002, 0.003, -0.003, 0.01, 0.2, 7.0, -60.0}) {
        INFO(by);
        records::PositionLog log = log_of(mill(99.0 + by), part);
        log.step = 1e-3;
        const auto gap = gap_of(mill(99.0), log, part);
        REQUIRE(!gap.causes.empty());
        CHECK(gap.causes.size() == 1);
        CHECK(gap.causes[0].name == "H1");
        CHECK(gap.causes[0].rivals.empty());
        REQUIRE(gap.causes[0].numbers.size() == 1);
        CHECK(gap.causes[0].numbers[0].to == Approx(99.0 + by).margin(3e-4));
    }
}

}  // namespace trunnion

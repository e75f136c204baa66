// A control that counts inches in 0.0001: no gap of a program in inches.
#include "tests/choices/sampled_log.h"

namespace trunnion {

using choices::GapVerdict;
using log_bench::gap_of;
using log_bench::has_note;
using log_bench::mill_of;

namespace {

const std::string inches = R"(N10 G90 G21 G17 G54
N20 G0 X5. Y6. Z50.
N30 G1 X12.3 F300.
N40 Y21.7
N50 G91 G20 G1 X-.5 Y.25
N60 X.1 Y.3
N70 G90 G21 G0 Z50.5
N80 M30
)";

/// N50 and N60 end on whole 0.0001 inch, `more_mm` aside.
records::PositionLog counted(double more_mm) {
    records::PositionLog log = log_bench::log_of(mill_of(), inches);
    constexpr double count_mm = 25.4e-4;
    for (records::LoggedPosition& row : log.rows)
        if (row.block == 5 || row.block == 6)
            for (const Axis axis : {Axis::X, Axis::Y})
                row.at[axis] = count_mm * std::round(row.at[axis] / count_mm) + more_mm;
    return log;
}

}  // namespace

TEST_CASE("blocks in inches may be off by the increment of the other control") {
    const auto gap = gap_of(mill_of(), counted(0.0), inches);
    CHECK(gap.verdict == GapVerdict::no_gap);
    CHECK(has_note(gap, "0.0001 inch"));
    CHECK(gap_of(mill_of(), counted(0.006), inches).verdict != GapVerdict::no_gap);
}

}  // namespace trunnion

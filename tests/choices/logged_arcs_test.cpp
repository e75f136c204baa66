// A trace with arcs: full circles whose ends have noise, and a log that begins with an arc.
#include "base/random.h"
#include "tests/choices/sampled_log.h"

namespace trunnion {

using choices::GapVerdict;
using log_bench::gap_of;
using log_bench::has_note;
using log_bench::mill_of;

namespace {

const std::string circles = R"(N10 G90 G21 G17 G54
N20 G0 X20. Y0. Z5.
N30 G1 X30. F300.
N40 X31. Y2.
N50 G2 X41. Y12. I10. J0.
N60 G1 X50. Y20.
N70 G2 X50. Y20. I5. J0. Z-2.
N80 G3 X60. Y30. I0. J10.
N90 G1 X62. Y31.
N100 X40. Y10.
N110 G0 Z50.
N120 M30
)";

/// mm: end, centre (of arcs), turns (0: a line).
struct Move {
    int block;
    Vector3 end, centre;
    double turns;
};
const Move moves[] = {{20, {20, 0, 5}, {}, 0},
                      {30, {30, 0, 5}, {}, 0},
                      {40, {31, 2, 5}, {}, 0},
                      {50, {41, 12, 5}, {41, 2, 5}, -1},
                      {60, {50, 20, 5}, {}, 0},
                      {70, {50, 20, -2}, {55, 20, 0}, -1},
                      {80, {60, 30, -2}, {50, 30, 0}, 1},
                      {90, {62, 31, -2}, {}, 0},
                      {100, {40, 10, -2}, {}, 0},
                      {110, {40, 10, 50}, {}, 0}};

/// Ends with a noise, mm; without the first ones.
records::PositionLog trace_of(std::size_t first, double noise_mm, std::uint64_t seed) {
    SeededNoise random(seed);
    records::PositionLog log = log_bench::SampledLog({0, 0, 0}).log;
    log.ends = true;
    for (std::size_t k = first; k < std::size(moves); ++k) {
        records::LoggedPosition row;
        const Axis axes[] = {Axis::X, Axis::Y, Axis::Z};
        for (int i = 0; i < 3; ++i)
            row.at[axes[i]] =
                std::round(1e4 * (moves[k].end[i] + noise_mm * random.normal())) / 1e4;
        if (moves[k].turns != 0.0) row.arc = {moves[k].centre, Vector3::UnitZ(), moves[k].turns};
        row.block = moves[k].block;
        row.end = true;
        row.line = static_cast<int>(log.rows.size()) + 2;
        log.rows.push_back(row);
    }
    return log;
}

}  // namespace

TEST_CASE("a trace with noise: a full circle stays one when its ends are not the same point") {
    for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6}) {
        const auto gap = gap_of(mill_of(), trace_of(0, 0.002, seed), circles);
        CHECK(gap.rms_um < 10.0);
        CHECK(gap.verdict == GapVerdict::no_gap);
    }
    CHECK(gap_of(mill_of(), trace_of(0, 0.0, 1), circles).verdict == GapVerdict::no_gap);
}

TEST_CASE("a trace that begins with an arc does not say where this arc began") {
    const auto gap = gap_of(mill_of(), trace_of(3, 0.0, 1), circles);
    CHECK(gap.verdict == GapVerdict::no_gap);
    CHECK(has_note(gap, "the log begins within the program"));
}

}  // namespace trunnion

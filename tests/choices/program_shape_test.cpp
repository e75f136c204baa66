// A long log without numbers of another program: told as such, without a search for causes.
#include <array>

#include "base/random.h"
#include "tests/choices/sampled_log.h"

namespace trunnion {

using choices::GapVerdict;
using log_bench::gap_of;
using log_bench::has_note;
using log_bench::mill_of;
using log_bench::Place;
using log_bench::SampledLog;

namespace {

constexpr const char* foreign = "is this the program that was logged?";
constexpr int cuts = 120;

/// Ends of oblique lines, mm.
std::array<Place, cuts> ends_of(std::uint64_t seed) {
    SeededNoise random(seed);
    std::array<Place, cuts> out;
    for (Place& end : out)
        for (double& at : end) at = std::round(1000.0 * (60.0 * random.uniform() - 30.0)) / 1000.0;
    return out;
}

std::string program_of_ends(std::uint64_t seed) {
    std::string out = "N1 G90 G21 G17 G54\nG1 F300.\n";
    for (const Place& end : ends_of(seed))
        out += "X" + std::to_string(end[0]) + " Y" + std::to_string(end[1]) + " Z" +
               std::to_string(end[2]) + "\n" + "G2 X" + std::to_string(end[0] + 4.0) + " R2.\nG1\n";
    return out + "M30\n";
}

/// Without numbers. `aside`: of all ways in X, mm.
records::PositionLog log_of_ends(std::uint64_t seed, double aside) {
    SampledLog log({aside, 0, 0});
    for (Place end : ends_of(seed)) {
        end[0] += aside;
        log.to(0, end, 1.3);
        const Place from = end;
        for (int k = 1; k <= 8; ++k) {
            const double angle = pi * k / 8.0;
            log.add(0, {from[0] + 2.0 - 2.0 * std::cos(angle), from[1] + 2.0 * std::sin(angle),
                        from[2]});
        }
    }
    log.log.blocks = records::BlockColumn::none;
    return log.log;
}

}  // namespace

// The note is that of an answer without a search.
TEST_CASE("a long log of another program is told as such without a search") {
    const auto gap = gap_of(mill_of(), log_of_ends(1, 0.0), program_of_ends(2));
    CHECK(gap.verdict == GapVerdict::unexplained);
    CHECK(has_note(gap, foreign));
    REQUIRE(gap.causes.size() == 1);
    CHECK(!gap.causes[0].known);
}

TEST_CASE("a long log of this program beside a stale store is no other program's") {
    const auto gap = gap_of(mill_of(), log_of_ends(1, 0.4), program_of_ends(1));
    CHECK(!has_note(gap, foreign));
    CHECK(gap.verdict != GapVerdict::no_gap);
    CHECK(gap.causes.front().known);
}

}  // namespace trunnion

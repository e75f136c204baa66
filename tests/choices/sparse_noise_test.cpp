// Logs with few rows a block, or ends of moves only, whose noise nobody states.
#include "base/random.h"
#include "tests/choices/sampled_log.h"

namespace trunnion {

using choices::GapVerdict;
using log_bench::gap_of;
using log_bench::mill_of;

namespace {

constexpr const char* offset = "work_offsets.G54 = { X = -12.5, Y = 8.75, Z = -100.25 }\n";

/// Lines in all directions, N numbers of ten.
std::string lines_of(int seed, int count) {
    SeededNoise random(static_cast<std::uint64_t>(seed));
    std::string out = "N10 G21 G90 G17 G54\nN20 G0 X5. Y5. Z30.\n";
    for (int k = 3; k < count; ++k) {
        const auto place = [&](double most) { return std::round(most * random.uniform()); };
        out += "N" + std::to_string(10 * k) + " G1 X" + std::to_string(place(80.0)) + " Y" +
               std::to_string(place(60.0)) + " Z" + std::to_string(-place(20.0)) + " F600\n";
    }
    return out + "N" + std::to_string(10 * count) + " M30\n";
}

struct Noisy {
    int rows_a_block = 3;
    double noise_mm = 0.002, shift_mm = 0.0;
    int seed = 1;
};

/// Rows at equal parts of each move, the last one at its end.
records::PositionLog sampled(const std::string& program, const Noisy& by) {
    records::PositionLog ends = log_bench::log_of(mill_of(offset), program), log = ends;
    log.rows.clear();
    log.ends = false;
    log.step = 1e-4;
    SeededNoise random(static_cast<std::uint64_t>(by.seed));
    AxisPositions from;
    for (const records::LoggedPosition& end : ends.rows) {
        for (int part = 1; part <= by.rows_a_block; ++part) {
            records::LoggedPosition row = end;
            row.end = false;
            for (const Axis axis : log.axes) {
                const double at =
                    from[axis] + (end.at[axis] - from[axis]) * part / by.rows_a_block +
                    by.noise_mm * random.normal() + (axis == Axis::X ? by.shift_mm : 0.0);
                row.at[axis] = std::round(1e4 * at) / 1e4;
            }
            row.line = static_cast<int>(log.rows.size()) + 2;
            log.rows.push_back(row);
        }
        from = end.at;
    }
    return log;
}

/// The ends of all moves, with noise.
records::PositionLog noisy_ends(const std::string& program, const Noisy& by) {
    records::PositionLog log = log_bench::log_of(mill_of(offset), program);
    log.step = 1e-4;
    SeededNoise random(static_cast<std::uint64_t>(by.seed));
    for (records::LoggedPosition& row : log.rows)
        for (const Axis axis : log.axes)
            row.at[axis] = 1e-4 * std::round(1e4 * (row.at[axis] + by.noise_mm * random.normal() +
                                                    (axis == Axis::X ? by.shift_mm : 0.0)));
    return log;
}

}  // namespace

TEST_CASE("noise that nobody states in a log of few rows a block is no gap, and hides no shift") {
    int silent = 0, shifted = 0;
    constexpr int tests = 20;
    for (int seed = 1; seed <= tests; ++seed) {
        const std::string program = lines_of(seed, 14 + seed);
        Noisy by{2 + seed % 5, 0.001 * (1 + seed % 5), 0.0, seed};
        const auto quiet = gap_of(mill_of(offset), sampled(program, by), program);
        silent += quiet.verdict == GapVerdict::no_gap ? 1 : 0;
        by.noise_mm = 0.002;
        by.shift_mm = 0.006;
        const auto gap = gap_of(mill_of(offset), sampled(program, by), program);
        INFO("seed " << seed << ", p " << gap.p_value << ", noise " << gap.noise_um << ", rms "
                     << gap.rms_um);
        CHECK(gap.verdict != GapVerdict::no_gap);
        shifted += !gap.causes.empty() && gap.causes[0].name == "G54" ? 1 : 0;
    }
    CHECK(silent >= tests - 1);
    CHECK(shifted >= tests - 2);
}

TEST_CASE("noise that nobody states in a trace of ends is no gap, and hides no shift") {
    int silent = 0;
    constexpr int tests = 20;
    for (int seed = 1; seed <= tests; ++seed) {
        const std::string program = lines_of(seed, 20 + 2 * seed);
        Noisy by{1, 0.001 * (1 + seed % 5), 0.0, seed};
        const auto quiet = gap_of(mill_of(offset), noisy_ends(program, by), program);
        silent += quiet.verdict == GapVerdict::no_gap ? 1 : 0;
        by.noise_mm = 0.002;
        by.shift_mm = 0.006;
        CHECK(gap_of(mill_of(offset), noisy_ends(program, by), program).verdict !=
              GapVerdict::no_gap);
    }
    CHECK(silent >= tests - 1);
}

TEST_CASE(
    "a radius of cutter compensation is no noise of a trace of ends, beside other noise or none") {
    std::string program =
        "N10 G21 G90 G17 G54\nN20 G0 X5. Y5. Z30.\nN30 G41 D1 G1 X20. Y20. F600\n";
    for (int k = 0; k < 12; ++k)
        program += "X" + std::to_string(30 + 10 * k) + ".\nY" + std::to_string(30 + 5 * k) + ".\n";
    program += "G40 X5. Y5.\nG0 Z50.\nM30\n";
    const auto mill = [](double diameter) {
        return mill_of(std::string(offset) + "tools.1 = { length_mm = 50, diameter_mm = " +
                       std::to_string(diameter) + " }\n");
    };
    for (const double noise_mm : {0.0, 0.0015}) {
        records::PositionLog log = log_bench::log_of(mill(6.012), program);
        log.step = 1e-4;
        SeededNoise random(5);
        for (records::LoggedPosition& row : log.rows)
            for (const Axis axis : log.axes)
                row.at[axis] = 1e-4 * std::round(1e4 * (row.at[axis] + noise_mm * random.normal()));
        const auto gap = gap_of(mill(6.0), log, program);
        INFO("noise " << noise_mm << " verdict " << to_string(gap.verdict));
        REQUIRE(!gap.causes.empty());
        CHECK(gap.causes[0].name == "D1");
    }
}

TEST_CASE("noise that nobody states in a short trace of ends is no gap") {
    int silent = 0;
    constexpr int tests = 20;
    for (int seed = 1; seed <= tests; ++seed) {
        const std::string program = lines_of(seed, 11);
        const auto gap =
            gap_of(mill_of(offset), noisy_ends(program, {1, 0.003, 0.0, seed}), program);
        silent += gap.verdict == GapVerdict::no_gap ? 1 : 0;
    }
    CHECK(silent >= tests - 1);
}

TEST_CASE("differences that depend on the positions are no noise of a trace of ends") {
    const std::string program = lines_of(3, 40);
    records::PositionLog log = noisy_ends(program, {1, 0.0, 0.0, 1});
    for (records::LoggedPosition& row : log.rows) row.at[Axis::X] *= 1.0 + 5e-5;
    CHECK(gap_of(mill_of(offset), log, program).verdict != GapVerdict::no_gap);
}

}  // namespace trunnion

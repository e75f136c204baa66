// A play that winds up behind each reversal (preload, friction, a coupling): an autocollimator over
// a whole turn, there and back. It is a play with a table, and no course of time.
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <random>

#include "base/units.h"
#include "tests/support/diagnosed.h"
#include "tests/support/said.h"

namespace trunnion {
namespace {

constexpr double noise_rad = 1e-6;

setup::Setup turntable() {
    std::vector<std::string> notes;
    return setup::parse_setup(
        "[machine]\nname = \"t\"\nchain = \"w C b t\"\n"
        "[machine.axis.C]\ndirection = [0, 0, 1]\npoint_mm = [0, 0, 0]\n"
        "[[artefact]]\nname = \"R1\"\nkind = \"target\"\ntool_mm = [0, 0, 0]\n"
        "[model]\nmodelled = []\n",
        "s.toml", notes);
}

/// `at`: error of a position (of the turn, 0 to 1) on a side.
using ErrorAt = std::function<double(double at, int side)>;

records::ReadingTable there_and_back(int cycles, int steps, unsigned seed, const ErrorAt& at) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> noise(0.0, noise_rad);
    records::ReadingTable table;
    table.path = "turn.csv";
    table.axes = {Axis::C};
    const auto add = [&](double turn, int side) {
        records::Reading row;
        row.index = static_cast<int>(table.rows.size());
        row.time_s = 10.0 * row.index;
        row.test = "turn";
        row.commanded[Axis::C] = 2.0 * pi * turn;
        if (side != 0) {
            row.device = records::Device::angle;
            row.feature = "R1";
            row.angular = true;
            row.direction_M = Vector3::UnitZ();
            row.value_mm = at(turn, side) + noise(engine);
        }
        table.rows.push_back(row);
    };
    for (int cycle = 0; cycle < cycles; ++cycle) {
        add(-0.02, 0);
        for (int k = 0; k <= steps; ++k) add(1.0 * k / steps, 1);
        add(1.02, 0);
        for (int k = steps; k >= 0; --k) add(1.0 * k / steps, -1);
    }
    return table;
}

/// Behind a reversal the table stands where it stood, and lags by half the play at last.
double wound_up_rad(double play_rad, double decay, double at, int side) {
    const double way = side > 0 ? at : 1.0 - at;
    return -side * 0.5 * play_rad * (1.0 - 2.0 * std::exp(-way / decay));
}

}  // namespace

TEST_CASE("a play that winds up behind each reversal is a play, over a whole turn too",
          "[diagnosis][play]") {
    const int cycles = GENERATE(3, 5), steps = GENERATE(8, 20, 30);
    const double decay = GENERATE(0.1, 0.25);
    const records::ReadingTable table = there_and_back(cycles, steps, 7, [&](double at, int side) {
        return wound_up_rad(9e-6, decay, at, side) + 6e-6 * std::sin(2.0 * pi * at);
    });
    const diagnosis::Diagnosis d = diagnosed(turntable(), table);
    INFO(cycles << " cycles, " << steps << " steps, " << decay << ": " << said(d));
    CHECK(d.verdict != diagnosis::Verdict::unexplained);
    CHECK(d.verdict != diagnosis::Verdict::no_gap);
    CHECK(probability_of(d, "C.backlash") > 0.7);
    // Half of what stands behind the reversals alone is 2.5 noises.
    CHECK(left_beside(d.setup, table) < 1.9 * noise_rad);
}

TEST_CASE("a zero that wanders to and fro from cycle to cycle is no play", "[diagnosis][play]") {
    std::mt19937_64 engine(3);
    std::normal_distribution<double> step(0.0, 1.2e-6);
    double zero_rad = 0.0;
    const records::ReadingTable table =
        there_and_back(4, 20, 9, [&](double, int) { return zero_rad += step(engine); });
    const diagnosis::Diagnosis d = diagnosed(turntable(), table);
    INFO(said(d));
    CHECK(d.verdict != diagnosis::Verdict::no_gap);
    CHECK(probability_of(d, "C.backlash") < 0.9);
}

}  // namespace trunnion

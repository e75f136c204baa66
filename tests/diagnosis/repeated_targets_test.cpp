// The noise that repeated targets of a laser tell where a few readings are wild and the zero jumps.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "diagnosis/diagnosis.h"
#include "diagnosis/round.h"
#include "tests/support/laser_lines.h"

namespace trunnion {
namespace {

constexpr double noise_mm = 0.001, gap_mm = 0.01;
constexpr int targets = 10, of_cycle = 2 * targets;

/// Cycles up and down over ten targets with a play. Each cycle has a zero of its own; every fourth
/// reading is missing.
records::ReadingTable cycles(int count, unsigned seed) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> normal(0.0, 1.0);
    records::ReadingTable table = laser_lines::empty_table();
    table.side_before[index_of(Axis::X)] = -1;
    double zero_mm = 0.0;
    for (int k = 0; k < count * of_cycle; ++k) {
        const int in_cycle = k % of_cycle, side = in_cycle < targets ? 1 : -1;
        if (in_cycle == 0) zero_mm = 10.0 * noise_mm * normal(engine);
        records::Reading row;
        const double at_mm = 40.0 * (side > 0 ? in_cycle : of_cycle - 1 - in_cycle);
        row.test = "X";
        row.index = static_cast<int>(table.rows.size());
        if (in_cycle % targets == 0) {  // past the end, so that the side is known
            row.time_s = 20.0 * k - 10.0;
            row.commanded[Axis::X] = at_mm - side;
            table.rows.push_back(row);
            ++row.index;
        }
        row.time_s = 20.0 * k;
        row.commanded[Axis::X] = at_mm;
        row.feature = "R1";
        row.direction_M = Vector3(1, 0, 0);
        const double read_mm = zero_mm + 0.5 * side * gap_mm + noise_mm * normal(engine);
        if (engine() % 4 != 0) {
            row.device = records::Device::linear;
            row.value_mm = read_mm;
        }
        table.rows.push_back(row);
    }
    return table;
}

/// Adds to the readings from one on, as far as `end`.
void shift(records::ReadingTable& table, int first, int end, double by_mm) {
    for (records::Reading& row : table.rows)
        if (row.value_mm && row.time_s >= 20.0 * first && row.time_s < 20.0 * end)
            *row.value_mm += by_mm;
}

/// The noise told by repeats before anything is searched, relative to the true one.
double noise_told(const records::ReadingTable& table) {
    const diagnosis::Prepared p = diagnosis::prepare(laser_lines::stage(), table);
    const diagnosis::Round round{
        std::vector<bool>(p.replay.size(), true), {}, p.base.sigma_mm, false};
    const diagnosis::NoiseBelief noise = diagnosis::belief_of(p, p.base.residual_mm, round);
    REQUIRE(noise.model.source == diagnosis::NoiseSource::repeats);
    return noise.model.linear.scale * p.base.sigma_mm(0) / noise_mm;
}

/// Root of the mean square of what is told of 40 tests.
template <class Spoil>
double mean_told(int count, Spoil spoil) {
    double sum = 0.0;
    for (unsigned seed = 1; seed <= 40; ++seed) {
        records::ReadingTable table = cycles(count, seed);
        spoil(table);
        sum += std::pow(noise_told(table), 2);
    }
    return std::sqrt(sum / 40.0);
}

double backlash_mm(const diagnosis::Diagnosis& d) {
    for (const diagnosis::Cause& c : d.causes)
        if (c.effect == "X.backlash" && c.points.empty() && c.probability >= 0.5)
            return c.parameters.front().value;
    return 0.0;
}

}  // namespace

// Where few targets are common to two cycles, their zeros were taken for noise.
TEST_CASE("zeros of cycles, of which readings are missing, are no noise", "[diagnosis][repeats]") {
    for (const int count : {3, 5}) {
        INFO(count);
        CHECK(mean_told(count, [](records::ReadingTable&) {}) == Approx(1.0).epsilon(0.05));
    }
}

TEST_CASE("a few wild readings make no noise", "[diagnosis][repeats]") {
    const auto wild = [](records::ReadingTable& table) {
        shift(table, 7, 8, 15.0 * noise_mm);
        shift(table, 33, 34, -30.0 * noise_mm);
    };
    for (const int count : {3, 5}) {
        INFO(count);
        CHECK(mean_told(count, wild) == Approx(1.0).epsilon(0.1));
    }
}

TEST_CASE("a zero that jumps within a cycle makes no noise, and its cycle is two",
          "[diagnosis][repeats]") {
    const auto jump = [](records::ReadingTable& table) {
        shift(table, of_cycle + 9, 2 * of_cycle, 12.0 * noise_mm);
    };
    for (const int count : {3, 5}) {
        INFO(count);
        CHECK(mean_told(count, jump) == Approx(1.0).epsilon(0.15));
    }
    records::ReadingTable table = cycles(3, 5);
    CHECK(diagnosis::prepare(laser_lines::stage(), table).cycle.back() == 2);
    jump(table);
    CHECK(diagnosis::prepare(laser_lines::stage(), table).cycle.back() == 3);
}

TEST_CASE("a play is found beside wild readings", "[diagnosis][repeats]") {
    for (const unsigned seed : {1u, 2u, 3u, 4u, 5u}) {
        records::ReadingTable table = cycles(3, seed);
        shift(table, 7, 8, 15.0 * noise_mm);
        shift(table, 31, 33, -20.0 * noise_mm);
        shift(table, 52, 53, 25.0 * noise_mm);
        diagnosis::DiagnosisOptions options;
        options.plan_next = false;
        const diagnosis::Diagnosis d = diagnosis::diagnose(laser_lines::stage(), table, options);
        INFO(seed);
        std::string said;
        for (const diagnosis::Cause& c : d.causes)
            said += fmt::format("{} {:.2f} ", c.effect, c.probability.value());
        INFO(said);
        CHECK(d.noise_um.value() == Approx(1e3 * noise_mm).epsilon(0.5));
        CHECK(backlash_mm(d) == Approx(gap_mm).margin(0.0015));
    }
}

}  // namespace trunnion

// An axis that never moves tells nothing, wherever it stands.
#include <catch2/catch.hpp>
#include <cmath>

#include "base/random.h"
#include "diagnosis/diagnosis.h"
#include "tests/support/laser_lines.h"
#include "tests/support/said.h"

namespace trunnion {
namespace {

/// A laser along X with a scale of 40 ppm, Z at rest.
diagnosis::Diagnosis with_z_at(double z_mm, std::uint64_t seed) {
    records::ReadingTable table = laser_lines::empty_table();
    laser_lines::add_runs(table, {.test = "X", .step_mm = 30.0, .places = 11, .z_mm = z_mm});
    SeededNoise random(seed);
    for (records::Reading& row : table.rows)
        row.value_mm = 40e-6 * row.commanded[Axis::X] + 0.5e-3 * random.normal();
    return diagnosis::diagnose(laser_lines::mill("w b X Y Z t", 150.0, 0.5), table);
}

}  // namespace

// What the zero of the test leaves of the column of a resting axis is rounding: as a rival it had
// explained anything, and a certain scale had a probability of 0.00.
TEST_CASE("the place of a resting axis does not matter", "[diagnosis][rest]") {
    for (const std::uint64_t seed : {1, 2}) {
        const double whole = probability_of(with_z_at(32.0, seed), "X.scale");
        CHECK(whole > 0.5);
        for (const double z_mm : {32.2, -17.371, 0.1, 101.003}) {
            const diagnosis::Diagnosis d = with_z_at(z_mm, seed);
            INFO(z_mm << ", seed " << seed << ": " << said(d));
            CHECK(std::abs(probability_of(d, "X.scale") - whole) < 0.01);
        }
    }
}

}  // namespace trunnion

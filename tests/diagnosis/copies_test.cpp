// A log that is faster than its sensor writes each reading several times.
#include "diagnosis/prepare/copies.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "base/random.h"
#include "diagnosis/diagnosis.h"
#include "setup/setup.h"
#include "tests/support/laser_lines.h"

namespace trunnion {
namespace {

using laser_lines::stage;

/// 39 readings of 50 um scatter at one place, each written `times` times, in steps of `digit_mm`.
records::ReadingTable log(int times, double digit_mm) {
    SeededNoise random(4);
    records::ReadingTable table;
    table.path = "log.csv";
    table.axes = {Axis::X, Axis::Y, Axis::Z};
    for (int k = 0; k < 39; ++k) {
        const double value_mm = digit_mm * std::round(0.05 * random.normal() / digit_mm);
        for (int again = 0; again < times; ++again) {
            records::Reading row;
            row.index = static_cast<int>(table.rows.size());
            row.time_s = 0.1 * row.index;
            row.test = "rest";
            row.device = records::Device::linear;
            row.feature = "R1";
            row.direction_M = Vector3(0, 0, 1);
            row.value_mm = value_mm;
            table.rows.push_back(row);
        }
    }
    return table;
}

}  // namespace

TEST_CASE("copies of a reading are one reading", "[diagnosis]") {
    const records::ReadingTable five = log(5, 1e-4);
    const auto once = diagnosis::without_copies(five);
    REQUIRE(once);
    CHECK(once->rows.size() == 39);
    CHECK(once->rows[3].index == 15);  // the first of each run
    CHECK_FALSE(diagnosis::without_copies(log(1, 1e-4)));

    const diagnosis::Diagnosis read_once = diagnosis::diagnose(stage(), log(1, 1e-4));
    const diagnosis::Diagnosis read_five = diagnosis::diagnose(stage(), five);
    CHECK(read_five.copies == 156);
    CHECK(read_five.readings == 39);
    CHECK(read_once.verdict == diagnosis::Verdict::no_gap);
    CHECK(read_five.verdict == diagnosis::Verdict::no_gap);
    CHECK(read_five.noise_um.value() == Approx(read_once.noise_um.value()).epsilon(1e-6));
}

TEST_CASE("equal values of few digits are no copies", "[diagnosis]") {
    CHECK_FALSE(diagnosis::without_copies(log(1, 0.2)));  // nearly all are 0
    records::ReadingTable moved = log(5, 1e-4);
    for (records::Reading& row : moved.rows) row.commanded[Axis::X] = row.index;
    CHECK_FALSE(diagnosis::without_copies(moved));  // each at a place of its own
    records::ReadingTable loaded = log(5, 1e-4);
    for (records::Reading& row : loaded.rows) row.load_kg = 20.0 * (row.index % 5);
    CHECK_FALSE(diagnosis::without_copies(loaded));  // each under a load of its own
}

TEST_CASE("nine equal readings may be chance, ten copies are not", "[diagnosis]") {
    for (const std::size_t copies : {9, 10, 11}) {
        records::ReadingTable table = log(2, 1e-4);
        table.rows.resize(2 * copies);
        INFO(copies);
        CHECK(diagnosis::without_copies(table).has_value() == (copies >= 10));
    }
}

}  // namespace trunnion

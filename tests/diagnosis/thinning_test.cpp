// Very long tables: an even choice keeps what sides, velocities and zeros come from.
#include "diagnosis/prepare/thinning.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "records/samples.h"
#include "tests/support/campaign.h"

namespace trunnion {

TEST_CASE("of a long table an even choice of readings stays", "[diagnosis]") {
    const setup::Setup setup = campaign::bc_setup();
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 400, 3);
    campaign::add_ballbar(table, setup, 1500);
    for (records::Reading& row : table.rows)
        if (row.device != records::Device::none) row.value_mm = 0.0;
    CHECK_FALSE(diagnosis::thinned(table, table.rows.size()));
    const auto fewer = diagnosis::thinned(table, 4000);
    REQUIRE(fewer);
    std::map<std::string, std::size_t> count, all;
    for (const records::Reading& row : fewer->rows)
        if (row.device != records::Device::none) ++count[row.test];
    for (const records::Reading& row : table.rows)
        if (row.device != records::Device::none) ++all[row.test];
    REQUIRE(count.size() == all.size());  // every pass is there
    std::size_t sum = 0;
    for (const auto& [test, n] : count) {
        sum += n;
        if (test == "map")
            CHECK(n == all[test]);  // few places beside a stream: all stay
        else
            CHECK(static_cast<double>(n) ==
                  Approx(static_cast<double>(all[test]) / 12.0).epsilon(0.05));
    }
    CHECK(sum <= 4300);
    // Sides and velocities are those of the whole table.
    const auto whole = records::samples_of(table), part = records::samples_of(*fewer);
    std::map<double, std::size_t> at;
    for (std::size_t i = 0; i < table.rows.size(); ++i) at[table.rows[i].time_s] = i;
    for (std::size_t i = 0; i < fewer->rows.size(); ++i) {
        if (fewer->rows[i].device == records::Device::none) continue;
        const AxisSample& there = whole[at[fewer->rows[i].time_s]];
        for (const Axis axis : table.axes) {
            if (fewer->rows[i].device == records::Device::sphere)
                CHECK(part[i].travel[index_of(axis)] == there.travel[index_of(axis)]);
            CHECK(std::abs(part[i].velocity[axis] - there.velocity[axis]) < 3.5);  // of 67 mm/s
        }
    }
}

TEST_CASE("many places beside a stream share the room", "[diagnosis]") {
    const setup::Setup setup = campaign::bc_setup();
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 2000, 3);
    campaign::add_ballbar(table, setup, 1500);
    for (records::Reading& row : table.rows)
        if (row.device != records::Device::none) row.value_mm = 0.0;
    const auto fewer = diagnosis::thinned(table, 5000);
    REQUIRE(fewer);
    std::map<records::Device, std::size_t> count;
    for (const records::Reading& row : fewer->rows) ++count[row.device];
    CHECK(count[records::Device::sphere] == 2001);  // every third pose of 2000
    CHECK(count[records::Device::ballbar] > 2400);
    CHECK(count[records::Device::ballbar] < 3100);
}

// Rows here and there are at unequal distances: their own differences are neither the speed nor the
// reversal point, and a peak behind a reversal would be somewhere else.
TEST_CASE("chosen rows of a ballbar have speeds and reversals of the whole pass", "[diagnosis]") {
    const setup::Setup setup = campaign::bc_setup();
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_ballbar(table, setup, 1500);
    for (records::Reading& row : table.rows)
        if (row.device != records::Device::none) row.value_mm = 0.0;
    TimeConstants constants{};
    constants[index_of(Axis::X)] = 0.02;
    const auto all = records::samples_of(table, constants);
    std::map<double, std::size_t> at;
    for (std::size_t i = 0; i < table.rows.size(); ++i) at[table.rows[i].time_s] = i;
    const auto once = diagnosis::thinned(table, 4000, constants);
    REQUIRE(once);
    const auto twice = diagnosis::thinned(*once, 2000, constants);
    REQUIRE(twice);
    for (const records::ReadingTable* fewer : {&*once, &*twice}) {
        const auto kept = records::samples_of(*fewer, constants);
        for (std::size_t i = 0; i < kept.size(); ++i) {
            const AxisSample& whole = all[at[fewer->rows[i].time_s]];
            REQUIRE(kept[i].since_reversal == whole.since_reversal);
            REQUIRE(kept[i].run_up_unknown == whole.run_up_unknown);
            REQUIRE(kept[i].travel == whole.travel);
            REQUIRE(kept[i].path_mm == whole.path_mm);
            for (const Axis axis : table.axes) {
                REQUIRE(kept[i].velocity[axis] == whole.velocity[axis]);
                REQUIRE(kept[i].acceleration[axis] == whole.acceleration[axis]);
                REQUIRE(kept[i].jerk[axis] == whole.jerk[axis]);
                REQUIRE(kept[i].smooth_velocity[axis] == whole.smooth_velocity[axis]);
            }
        }
    }
}

// Each sphere is found at the same angles in two tests, one after the other: four poses.
TEST_CASE("the readings of a pose are kept together or left out together", "[diagnosis]") {
    const setup::Setup setup = campaign::bc_setup();
    records::ReadingTable table = campaign::empty_table(setup);
    for (int k = 0; k < 80; ++k)
        for (int d = 0; d < 3; ++d) {
            records::Reading row;
            row.test = k / 2 % 2 ? "second" : "first";
            row.feature = k % 2 ? "S1" : "S2";
            row.device = records::Device::sphere;
            row.commanded[Axis::C] = 0.1 * (k / 4);
            row.commanded[Axis::X] = d;  // a linear axis may move within a pose
            row.value_mm = 0.0;
            row.time_s = 10.0 * k;
            table.rows.push_back(row);
        }
    const auto fewer = diagnosis::thinned(table, 120);
    REQUIRE(fewer);
    std::map<double, int> readings;
    for (const records::Reading& row : fewer->rows)
        if (row.device != records::Device::none) ++readings[row.time_s];
    CHECK(readings.size() == 40);
    for (const auto& [time_s, count] : readings) {
        INFO(time_s);
        CHECK(count == 3);
        CHECK(std::lround(time_s / 10.0) % 2 == 0);  // every second one
    }
}

namespace {

/// X to and fro, 6,000 rows without an error.
records::ReadingTable long_log() {
    records::ReadingTable table;
    table.path = "log.csv";
    table.axes = {Axis::X, Axis::Y, Axis::Z};
    for (int k = 0; k < 6000; ++k) {
        records::Reading row;
        row.index = k;
        row.time_s = 0.005 * k;
        row.test = "log";
        row.device = records::Device::axis;
        row.feature = "X";
        row.commanded[Axis::X] = 40.0 * std::sin(6.28 * row.time_s);
        row.value_mm = 0.0;
        table.rows.push_back(row);
    }
    return table;
}

}  // namespace

TEST_CASE("rows of a servo log keep the speed of the whole log", "[diagnosis]") {
    const records::ReadingTable table = long_log();
    const auto all = records::samples_of(table);
    const auto fewer = diagnosis::thinned(table, 2000);
    REQUIRE(fewer);
    CHECK(fewer->rows.size() < 2500);
    const auto kept = records::samples_of(*fewer);
    for (std::size_t i = 0; i < kept.size(); ++i) {
        const AxisSample& whole = all[static_cast<std::size_t>(fewer->rows[i].index)];
        CHECK(kept[i].velocity[Axis::X] == whole.velocity[Axis::X]);
        CHECK(kept[i].acceleration[Axis::X] == whole.acceleration[Axis::X]);
        CHECK(kept[i].since_reversal[0] == whole.since_reversal[0]);
        CHECK(kept[i].travel[0] == whole.travel[0]);
    }
}

TEST_CASE("rows of a thinned log answer to the motion of the whole log", "[diagnosis]") {
    const records::ReadingTable table = long_log();
    TimeConstants constants{};
    constants[index_of(Axis::X)] = 0.02;
    const auto all = records::samples_of(table, constants);
    const auto fewer = diagnosis::thinned(table, 2000, constants);
    REQUIRE(fewer);
    const auto kept = records::samples_of(*fewer, constants);
    for (std::size_t i = 0; i < kept.size(); ++i) {
        const AxisSample& whole = all[static_cast<std::size_t>(fewer->rows[i].index)];
        CHECK(kept[i].velocity[Axis::X] + kept[i].smooth_velocity[Axis::X] ==
              Approx(whole.velocity[Axis::X] + whole.smooth_velocity[Axis::X]).margin(1e-9));
        CHECK(kept[i].jerk[Axis::X] + kept[i].smooth_jerk[Axis::X] ==
              Approx(whole.jerk[Axis::X] + whole.smooth_jerk[Axis::X]).margin(1e-6));
    }
}

TEST_CASE("a device row without a value is not thinned away", "[diagnosis]") {
    const setup::Setup setup = campaign::bc_setup();
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_ballbar(table, setup, 100);
    CHECK_FALSE(diagnosis::thinned(table, 10));
}

}  // namespace trunnion

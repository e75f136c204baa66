// An instrument that reads several times while the axes stand tells nothing of what the machine
// does not repeat.
#include "diagnosis/prepare/stop_means.h"

#include <catch2/catch.hpp>

#include "base/random.h"
#include "diagnosis/diagnosis.h"
#include "identification/row_noise.h"
#include "tests/support/laser_lines.h"
#include "tests/support/said.h"

namespace trunnion {
namespace {

using laser_lines::stage;

/// Three runs to and fro over 11 targets, `times` readings at each stop. Stops scatter by 2 um,
/// readings by 0.1 um.
records::ReadingTable stops(int times, std::uint64_t seed, double form_um) {
    SeededNoise random(seed);
    std::vector<double> form;
    for (int k = 0; k < 11; ++k) form.push_back(form_um * random.normal());
    records::ReadingTable once = laser_lines::empty_table();
    laser_lines::add_runs(once, {.test = "X", .step_mm = 30.0, .places = 11});
    records::ReadingTable table = once;
    table.rows.clear();
    for (const records::Reading& row : once.rows) {
        const auto place = static_cast<std::size_t>(std::lround(row.commanded[Axis::X] / 30.0));
        const double stop_um = form[place] + 2.0 * random.normal();
        for (int again = 0; again < times; ++again) {
            table.rows.push_back(row);
            table.rows.back().time_s += 0.5 * again;
            table.rows.back().value_mm = 1e-3 * (stop_um + 0.1 * random.normal());
        }
    }
    return table;
}

std::optional<diagnosis::StopMeans> means_of(const setup::Setup& setup,
                                             const records::ReadingTable& table) {
    return diagnosis::means_of_stops(table, [&](const records::Reading& row) {
        return identification::states_noise(setup, row);
    });
}

}  // namespace

TEST_CASE("readings of one stop are one reading", "[diagnosis][stops]") {
    const records::ReadingTable table = stops(3, 1, 0.0);
    const auto found = means_of(stage(), table);
    REQUIRE(found);
    // At each end of the runs the axis turns where it stands: 66 readings at 61 stops.
    CHECK(found->readings == 198);
    CHECK(found->means == 61);
    REQUIRE(found->table.rows.size() == 61);
    CHECK(
        *found->table.rows[1].value_mm ==
        Approx((*table.rows[3].value_mm + *table.rows[4].value_mm + *table.rows[5].value_mm) / 3));
    CHECK(found->table.rows[1].time_s == table.rows[3].time_s);
    CHECK(found->table.rows[1].commanded == table.rows[3].commanded);
}

TEST_CASE("what moves between readings, other directions and stated noise are no stop",
          "[diagnosis][stops]") {
    records::ReadingTable moved = stops(2, 1, 0.0);
    std::vector<records::Reading> rows;
    for (const records::Reading& row : moved.rows) {
        rows.push_back(row);
        records::Reading away = row;  // away and back
        away.device = records::Device::none;
        away.value_mm.reset();
        away.commanded[Axis::X] += 1.0;
        rows.push_back(away);
    }
    moved.rows = rows;
    CHECK_FALSE(means_of(stage(), moved));

    records::ReadingTable across = stops(2, 1, 0.0);
    for (std::size_t i = 1; i < across.rows.size(); i += 2)
        across.rows[i].direction_M = Vector3::UnitY();
    for (std::size_t i = 1; i < across.rows.size(); ++i)  // no turn where it stands
        across.rows[i].load_kg = across.rows[i].commanded == across.rows[i - 1].commanded
                                     ? across.rows[i - 1].load_kg
                                     : across.rows[i - 1].load_kg + 1.0;
    std::size_t same = 0;
    const auto found = means_of(stage(), across);
    if (found) same = across.rows.size() - found->table.rows.size();
    CHECK(same == 10);  // the two readings of a turn, in both directions, five times

    CHECK_FALSE(means_of(stage("noise_um = { linear = 0.1 }\n"), stops(2, 1, 0.0)));
    records::ReadingTable stated = stops(2, 1, 0.0);
    for (records::Reading& row : stated.rows) row.sigma_mm = 1e-4;
    CHECK_FALSE(means_of(stage(), stated));
    CHECK_FALSE(means_of(stage(), laser_lines::empty_table()));
}

TEST_CASE("a watch at rest keeps its readings", "[diagnosis][stops]") {
    records::ReadingTable table = laser_lines::empty_table();
    for (int k = 0; k < 240; ++k) {  // an hour at each of four places
        records::Reading row;
        row.index = k;
        row.time_s = 60.0 * k;
        row.commanded[Axis::X] = 50.0 * (k / 60);
        row.test = "watch";
        row.device = records::Device::linear;
        row.feature = "R1";
        row.direction_M = Vector3::UnitX();
        row.value_mm = 1e-6 * k;
        table.rows.push_back(row);
    }
    CHECK(means_of(stage(), table));  // four hours: a quarter at most
    std::erase_if(table.rows, [](const records::Reading& row) { return row.index >= 180; });
    CHECK_FALSE(means_of(stage(), table));  // three stops
    for (records::Reading& row : table.rows)
        if (row.index >= 170) row.commanded[Axis::X] += row.index;
    CHECK_FALSE(means_of(stage(), table));  // a third of the time at one
}

TEST_CASE("more readings at each stop make no gap of what the machine does not repeat",
          "[diagnosis][stops]") {
    for (const int times : {1, 2, 3})
        for (const std::uint64_t seed : {1u, 2u, 3u}) {
            const diagnosis::Diagnosis none = diagnosis::diagnose(stage(), stops(times, seed, 0.0));
            INFO(times << " readings, seed " << seed << ": " << said(none));
            CHECK(none.verdict == diagnosis::Verdict::no_gap);
        }
}

TEST_CASE("the form of an axis is found with any number of readings at a stop",
          "[diagnosis][stops]") {
    for (const int times : {1, 2, 3}) {
        const diagnosis::Diagnosis form = diagnosis::diagnose(stage(), stops(times, 7, 6.0));
        INFO(times << " readings: " << said(form));
        REQUIRE_FALSE(form.causes.empty());
        CHECK(form.causes.front().effect == "X.positioning");
        CHECK(form.explained > 0.8);
        CHECK(form.noise_um > 1.0);
    }
}

}  // namespace trunnion

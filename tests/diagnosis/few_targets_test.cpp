// A rotary axis against an autocollimator at few places: what an encoder does is found, and what
// each target has of its own is written for these targets.
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "base/units.h"
#include "diagnosis/diagnosis.h"
#include "effects/settings.h"
#include "emulator/replay.h"
#include "setup/setup.h"
#include "tests/support/said.h"

namespace trunnion {
namespace {

setup::Setup table() {
    std::vector<std::string> notes;
    return setup::parse_setup(
        "[machine]\nname = \"table\"\nchain = \"w b C t\"\n"
        "[machine.axis.C]\ndirection = [0, 0, 1]\npoint_mm = [0, 0, 0]\n"
        "[[artefact]]\nname = \"R1\"\nkind = \"target\"\ntool_mm = [0, 0, 0]\n"
        "[model]\nmodelled = []\n",
        "table.toml", notes);
}

using Error = double (*)(int target, double q);

/// One pass forward, or passes to and fro; `first_rad`: where they begin.
records::ReadingTable read(Error error, int targets, int passes, unsigned seed,
                           double first_rad = 0.0) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> noise(0.0, 1e-6);
    records::ReadingTable table;
    table.path = "c.csv";
    table.axes = {Axis::C};
    table.side_before[index_of(Axis::C)] = 1;
    for (int pass = 0; pass < passes; ++pass)
        for (int k = 0; k < targets; ++k) {
            const int target = pass % 2 ? targets - 1 - k : k;
            records::Reading row;
            row.index = static_cast<int>(table.rows.size());
            row.time_s = 60.0 * row.index;
            row.test = "C";
            row.device = records::Device::angle;
            row.feature = "R1";
            row.angular = true;
            row.direction_M = Vector3(0, 0, 1);
            row.commanded[Axis::C] = first_rad + 2.0 * pi * target / targets;
            row.value_mm = error(target, row.commanded[Axis::C]) + noise(engine);
            table.rows.push_back(row);
        }
    return table;
}

double eccentric(int, double q) {
    return 7e-6 * std::cos(q) + 16e-6 * std::sin(q) + 6.5e-6 * std::cos(2.0 * q) -
           26e-6 * std::sin(2.0 * q);
}

/// An error of its own at each target, without rule.
double any(int target, double) {
    return 1e-5 * std::sin(2.7 + 12.9898 * target * target + 4.1 * target);
}

/// Root mean square of what a setup leaves beside the zero of the readings.
double left_rad(const setup::Setup& setup, const records::ReadingTable& table) {
    const auto predicted = emulator::predicted(setup, table, effects::active_models(setup));
    const auto n = static_cast<double>(table.rows.size());
    double sum = 0.0, square = 0.0;
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const double left = *table.rows[i].value_mm - *predicted.rows[i].value_mm;
        sum += left;
        square += left * left;
    }
    return std::sqrt(square / n - sum * sum / (n * n));
}

}  // namespace

TEST_CASE("twelve places of one pass show an eccentric encoder", "[diagnosis]") {
    for (const unsigned seed : {1u, 2u, 3u, 4u}) {
        const diagnosis::Diagnosis d = diagnosis::diagnose(table(), read(eccentric, 12, 1, seed));
        INFO(seed);
        REQUIRE_FALSE(d.causes.empty());
        CHECK(d.causes.front().effect == "C.positioning");
        CHECK(d.causes.front().probability > 0.5);
        CHECK(d.explained > 0.8);
        // Between the places, too: all of it is 23 urad.
        CHECK(left_rad(d.setup, read(eccentric, 12, 1, 99, 0.26)) < 3e-6);
    }
}

TEST_CASE("errors of its own at each target of a turn are written for these targets",
          "[diagnosis]") {
    const diagnosis::Diagnosis d = diagnosis::diagnose(table(), read(any, 12, 6, 5));
    CHECK_FALSE(d.between_places);
    CHECK(d.explained > 0.8);
    CHECK(d.writes_causes);
    CHECK(left_rad(d.setup, read(any, 12, 4, 98)) < 1.3e-6);
    const auto listed = std::find_if(d.causes.begin(), d.causes.end(),
                                     [](const auto& c) { return !c.points.empty(); });
    REQUIRE(listed != d.causes.end());
    CHECK(listed->points.size() == 12);
}

TEST_CASE("harmonics of a turn say nothing across a gap between the places", "[diagnosis]") {
    for (const bool wide : {false, true}) {
        records::ReadingTable seen = read(eccentric, 12, 3, 7);
        std::erase_if(seen.rows, [&](const records::Reading& row) {
            const long target = std::lround(row.commanded[Axis::C] / (pi / 6.0));
            return wide ? target >= 6 && target <= 9 : target == 6;
        });
        const diagnosis::Diagnosis d = diagnosis::diagnose(table(), seen, {.plan_next = false});
        INFO(wide << ": " << said(d));
        REQUIRE_FALSE(d.causes.empty());
        CHECK(d.causes.front().effect == "C.positioning");
        CHECK(d.explained > 0.8);
        CHECK(d.between_places == !wide);
    }
}

TEST_CASE("positions of several turns are those of one circle", "[diagnosis]") {
    records::ReadingTable seen = read(eccentric, 12, 3, 7);
    for (records::Reading& row : seen.rows)
        if (row.commanded[Axis::C] > pi - 0.1) row.commanded[Axis::C] += 20.0 * pi;
    const diagnosis::Diagnosis d = diagnosis::diagnose(table(), seen, {.plan_next = false});
    INFO(said(d));
    REQUIRE_FALSE(d.causes.empty());
    CHECK(d.causes.front().effect == "C.positioning");
    CHECK(d.between_places);
}

}  // namespace trunnion

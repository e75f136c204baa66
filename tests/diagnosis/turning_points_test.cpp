// Circles of whole degrees have readings exactly where an axis turns back.
#include "diagnosis/prepare/turning_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "base/random.h"
#include "base/units.h"
#include "diagnosis/diagnosis.h"
#include "effects/settings.h"
#include "emulator/replay.h"
#include "tests/support/said.h"

namespace trunnion {
namespace {

constexpr double radius_mm = 100.0;

setup::Setup machine(const std::string& more = "") {
    std::vector<std::string> notes;
    return setup::parse_setup(
        "[machine]\nname = \"mill\"\nchain = \"w b Y X Z t\"\n"
        "[ballbar]\ncup_mm = [0, 0, -120]\nlength_mm = 100\n"
        "free = [\"cup\", \"length\"]\n"
        "[[artefact]]\nname = \"P1\"\nkind = \"center_pivot\"\n"
        "center_mm = [0, 0, -120]\nfree = [\"center\"]\n"
        "[model]\nmodelled = []\nnoise_um = { ballbar = 0.3 }\n" +
            more,
        "s.toml", notes);
}

/// A circle in a plane (0 XY, 1 YZ, 2 ZX) in steps of `step_deg`, rounded as in a file, with a run
/// up and an overrun.
void add_circle(records::ReadingTable& table, int plane, int sense, int step_deg,
                double feed_mm_min) {
    const double step_s = rad_from_deg(step_deg) * radius_mm / (feed_mm_min / 60.0);
    const Axis axes[] = {Axis::X, Axis::Y, Axis::Z};
    double time_s = table.rows.empty() ? 0.0 : table.rows.back().time_s + 60.0;
    for (int deg = -45; deg <= 405; deg += step_deg) {
        const double angle = sense * rad_from_deg(deg);
        const auto at_mm = [](double q) { return std::round(1e6 * radius_mm * q) * 1e-6; };
        records::Reading row;
        row.index = static_cast<int>(table.rows.size());
        row.time_s = time_s += step_s;
        row.test = fmt::format("{} {} {}", plane, sense, feed_mm_min);
        row.feed_mm_min = feed_mm_min;
        row.feature = "P1";
        row.commanded[axes[plane]] = at_mm(std::cos(angle));
        row.commanded[axes[(plane + 1) % 3]] = at_mm(std::sin(angle));
        if (deg >= 0 && deg <= 360) row.device = records::Device::ballbar;
        table.rows.push_back(row);
    }
}

records::ReadingTable empty_table() {
    records::ReadingTable table;
    table.path = "circle.csv";
    table.axes = {Axis::Y, Axis::X, Axis::Z};
    table.side_before.fill(1);
    return table;
}

/// An axis with play stays on its former side until it has crossed the gap.
void read_with_play(records::ReadingTable& table, double gap_mm, std::uint64_t seed) {
    SeededNoise random(seed);
    double side = 1.0, before = table.rows.front().commanded[Axis::X];
    for (records::Reading& row : table.rows) {
        const double x = row.commanded[Axis::X];
        if (x != before) side = x > before ? 1.0 : -1.0;
        before = x;
        if (row.device == records::Device::ballbar)
            row.value_mm = 0.5 * gap_mm * side * x / radius_mm + 0.3e-3 * random.normal();
    }
}

}  // namespace

TEST_CASE("readings at exact turning points are left out", "[diagnosis][turning]") {
    records::ReadingTable table = empty_table();
    add_circle(table, 0, 1, 5, 1000.0);
    read_with_play(table, 0.004, 1);
    const auto rest = diagnosis::without_turning_points(table);
    REQUIRE(rest);
    CHECK(rest->readings == 5);  // 0, 90, 180, 270 and 360 degrees
    CHECK(rest->table.rows.size() == table.rows.size());

    // Of a coarse circle they would be a third.
    records::ReadingTable coarse = empty_table();
    add_circle(coarse, 0, 1, 45, 1000.0);
    read_with_play(coarse, 0.004, 1);
    CHECK_FALSE(diagnosis::without_turning_points(coarse));

    // Turned by a third of a degree there are none.
    records::ReadingTable turned = empty_table();
    add_circle(turned, 0, 1, 5, 1000.0);
    for (records::Reading& row : turned.rows) {
        const double x = row.commanded[Axis::X], y = row.commanded[Axis::Y], a = 0.006;
        row.commanded[Axis::X] = x * std::cos(a) - y * std::sin(a);
        row.commanded[Axis::Y] = x * std::sin(a) + y * std::cos(a);
    }
    read_with_play(turned, 0.004, 1);
    CHECK_FALSE(diagnosis::without_turning_points(turned));
}

TEST_CASE("a play is no spike where circles have readings at their vertices",
          "[diagnosis][turning]") {
    for (const double gap_mm : {-0.004, 0.008})
        for (const std::uint64_t seed : {1, 2}) {
            records::ReadingTable table = empty_table();
            for (const int sense : {1, -1}) add_circle(table, 0, sense, 5, 1000.0);
            read_with_play(table, gap_mm, seed);
            const diagnosis::Diagnosis d = diagnosis::diagnose(machine(), table);
            INFO(gap_mm << ", seed " << seed << ": " << said(d));
            CHECK(probability_of(d, "X.backlash") > 0.9);
            for (const diagnosis::Cause& c : d.causes)
                if (c.effect != "X.backlash") CHECK(c.probability < 0.5);
        }
}

// On a circle at one feed the acceleration goes with the position.
TEST_CASE("at one feed scales are no lag of the second order", "[diagnosis][turning]") {
    const setup::Setup real = machine(
        "[effects]\n\"X.scale\" = { scale_ppm = 50 }\n\"Y.scale\" = { scale_ppm = 15 }\n"
        "\"Z.scale\" = { scale_ppm = -25 }\n");
    for (const bool two_feeds : {false, true}) {
        records::ReadingTable table = empty_table();
        for (int plane = 0; plane < 3; ++plane)
            for (const int sense : {1, -1})
                for (const double feed : {1000.0, 3000.0})
                    if (two_feeds || feed == 1000.0) add_circle(table, plane, sense, 3, feed);
        table = emulator::predicted(real, table, effects::active_models(real));
        SeededNoise random(3);
        for (records::Reading& row : table.rows)
            if (row.device == records::Device::ballbar) *row.value_mm += 0.2e-3 * random.normal();
        const diagnosis::Diagnosis d = diagnosis::diagnose(machine(), table);
        INFO(two_feeds << ": " << said(d));
        CHECK(probability_of(d, "servo.contour") <= 0.5);
        if (two_feeds) {
            CHECK(probability_of(d, "X.scale") > 0.5);
            continue;
        }
        CHECK(d.verdict == diagnosis::Verdict::ambiguous);
        for (const diagnosis::Cause& c : d.causes)
            if (c.effect == "servo.contour") {
                CHECK_THAT(c.what, Catch::Contains("another feed would tell"));
                for (const char* scale : {"X.scale", "Y.scale", "Z.scale"})
                    CHECK(std::count(c.rivals.begin(), c.rivals.end(), scale) == 1);
            }
    }
}

}  // namespace trunnion

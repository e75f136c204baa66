// A backlash that depends on the place: a laser's or an autocollimator's runs both ways (ISO 230-2)
// tell it, one way does not.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <random>

#include "base/units.h"
#include "diagnosis/diagnosis.h"
#include "effects/settings.h"
#include "emulator/replay.h"
#include "tests/support/said.h"

namespace trunnion {
namespace {

constexpr double range_mm = 400.0, sigma_mm = 4e-4;

setup::Setup machine() {
    std::vector<std::string> notes;
    return setup::parse_setup(
        "[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n"
        "[machine.axis.X]\ndirection = [1, 0, 0]\n"
        "[[artefact]]\nname = \"R1\"\nkind = \"target\"\ntool_mm = [0, 0, -150]\n"
        "[model]\nmodelled = []\nnoise_um = { linear = 0.4 }\n",
        "s.toml", notes);
}

using GapOverPlace = std::function<double(double at_mm)>;

/// Five runs over 21 targets, up and down, or only up. The play is in the values, not in a setup.
records::ReadingTable laser(const GapOverPlace& gap_mm, unsigned seed, bool both_ways = true) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> noise(0.0, sigma_mm);
    records::ReadingTable table;
    table.path = "laser.csv";
    table.axes = {Axis::X, Axis::Y, Axis::Z};
    table.side_before[index_of(Axis::X)] = -1;
    const auto add = [&](double at_mm, int side) {
        records::Reading row;
        row.index = static_cast<int>(table.rows.size());
        row.time_s = 5.0 * row.index;
        row.test = "laser";
        row.commanded[Axis::X] = at_mm;
        if (side != 0) {
            row.device = records::Device::linear;
            row.feature = "R1";
            row.direction_M = Vector3(1, 0, 0);
            row.value_mm = 0.5 * side * gap_mm(at_mm) + noise(engine);
        }
        table.rows.push_back(row);
    };
    for (int run = 0; run < 5; ++run) {
        add(-10.0, 0);
        for (int k = 0; k <= 20; ++k) add(20.0 * k, 1);
        add(range_mm + 10.0, 0);
        for (int k = 20; k >= 0 && both_ways; --k) add(20.0 * k, -1);
    }
    return table;
}

diagnosis::Diagnosis diagnosed(const records::ReadingTable& table) {
    diagnosis::DiagnosisOptions options;
    options.plan_next = false;
    return diagnosis::diagnose(machine(), table, options);
}

const diagnosis::Cause* table_of_play(const diagnosis::Diagnosis& d) {
    for (const diagnosis::Cause& c : d.causes)
        if (c.effect == "X.backlash" && !c.points.empty()) return &c;
    return nullptr;
}

/// Largest difference between the gap that the written setup has and the true one.
double farthest_mm(const setup::Setup& setup, const GapOverPlace& gap_mm) {
    double constant_mm = 0.0, most = 0.0;
    for (const setup::EffectSetting& e : setup.effects)
        if (e.name == "X.backlash") constant_mm = e.parameters.at("gap_mm").front();
    for (double at_mm = 0.0; at_mm <= range_mm; at_mm += 20.0)
        most = std::max(
            most, std::abs(constant_mm + setup.gap[index_of(Axis::X)](at_mm) - gap_mm(at_mm)));
    return most;
}

}  // namespace

TEST_CASE("a play that grows along the travel, or is worn in the middle, is a table",
          "[diagnosis]") {
    const GapOverPlace shapes[] = {
        [](double at_mm) { return 4e-3 + 8e-3 * at_mm / range_mm; },
        [](double at_mm) { return 10e-3 * std::exp(-std::pow((at_mm - 200.0) / 70.0, 2)); }};
    for (const GapOverPlace& gap_mm : shapes)
        for (const unsigned seed : {1u, 2u}) {
            const auto d = diagnosed(laser(gap_mm, seed));
            INFO(said(d));
            CHECK(d.explained > 0.9);
            const diagnosis::Cause* play = table_of_play(d);
            REQUIRE(play);
            CHECK(play->points.front().error == "gap");
            CHECK(d.after_rms_um < 0.6);
            for (const diagnosis::Cause& c : d.causes) CHECK(c.effect == "X.backlash");
            CHECK(farthest_mm(d.setup, gap_mm) < 4.0 * sigma_mm);
        }
}

// A rack: two curves, one for each direction, and medians of the runs without times.
TEST_CASE("a curve for each direction is a table of play in one cycle", "[diagnosis][cycle]") {
    const auto mean_mm = [](double x) { return 0.3 * std::sin(x / 450.0) - 2e-4 * x; };
    const auto gap_mm = [](double x) {
        return 0.3 * std::sin(x / 62.0) + 0.2 * std::sin(x / 34.0 + 1.0);
    };
    std::vector<std::string> notes;
    const setup::Setup router = setup::parse_setup(
        "[machine]\nname = \"router\"\nchain = \"w b X t\"\n"
        "[[artefact]]\nname = \"R1\"\nkind = \"target\"\ntool_mm = [0, 0, 0]\n"
        "[model]\nmodelled = []\n",
        "s.toml", notes);
    for (const unsigned seed : {1u, 2u}) {
        std::mt19937_64 engine(seed);
        std::normal_distribution<double> noise(0.0, 0.025);
        records::ReadingTable table;
        table.path = "rack.csv";
        table.axes = {Axis::X};
        table.comment[records::times_key] = records::invented;
        const auto add = [&](double x, int side) {
            records::Reading row;
            row.index = static_cast<int>(table.rows.size());
            row.time_s = 60.0 * row.index;
            row.test = "X";
            row.commanded[Axis::X] = x;
            if (side != 0) {
                row.device = records::Device::linear;
                row.feature = "R1";
                row.direction_M = Vector3::UnitX();
                row.value_mm = mean_mm(x) + 0.5 * side * gap_mm(x) + noise(engine);
            }
            table.rows.push_back(row);
        };
        add(-1.0, 0);
        for (int k = 0; k <= 75; ++k) add(20.0 * k, 1);
        add(1501.0, 0);
        for (int k = 75; k >= 0; --k) add(20.0 * k, -1);
        const diagnosis::Diagnosis d = diagnosis::diagnose(router, table);
        INFO(seed << ": " << said(d));
        const diagnosis::Cause* play = table_of_play(d);
        REQUIRE(play);
        CHECK(play->probability > 0.8);
        CHECK(d.after_rms_um < 35.0);
    }
}

TEST_CASE("the same play everywhere is no table", "[diagnosis]") {
    for (const unsigned seed : {1u, 2u, 3u}) {
        const auto d = diagnosed(laser([](double) { return 8e-3; }, seed));
        INFO(said(d));
        CHECK_FALSE(table_of_play(d));
        CHECK(d.verdict == diagnosis::Verdict::explained);
    }
}

TEST_CASE("a play is told only where the axis was read from both sides", "[diagnosis]") {
    const GapOverPlace gap_mm = [](double at_mm) {
        return 10e-3 * std::exp(-std::pow((at_mm - 200.0) / 70.0, 2));
    };
    records::ReadingTable table = laser(gap_mm, 1);
    const auto comes_back = [&](std::size_t i) {
        return i > 0 && table.rows[i - 1].commanded[Axis::X] > table.rows[i].commanded[Axis::X];
    };
    // On the way back the last place was read once, with a lost count, and the one before never.
    int at_end = 0;
    for (std::size_t i = table.rows.size(); i-- > 0;) {
        records::Reading& row = table.rows[i];
        if (!row.value_mm || !comes_back(i) || row.commanded[Axis::X] > 20.0) continue;
        if (row.commanded[Axis::X] == 0.0 && ++at_end == 3) {
            *row.value_mm -= 0.02;
        } else {
            row.device = records::Device::none;
            row.value_mm.reset();
        }
    }
    const auto d = diagnosed(table);
    INFO(said(d));
    const diagnosis::Cause* play = table_of_play(d);
    REQUIRE(play);
    CHECK(play->points.front().at == 40.0);
    CHECK(farthest_mm(d.setup, gap_mm) < 4.0 * sigma_mm);
}

TEST_CASE("runs one way do not tell play from positioning", "[diagnosis]") {
    const auto d = diagnosed(
        laser([](double at_mm) { return 10e-3 * std::exp(-std::pow((at_mm - 200.0) / 70.0, 2)); },
              1, false));
    INFO(said(d));
    CHECK_FALSE(table_of_play(d));
}

namespace {

constexpr double sigma_rad = 2e-6;

/// Four runs of an autocollimator, up and down: whole turns of B in steps of 10 degrees, or 90
/// degrees to both sides in steps of 7.5.
records::ReadingTable autocollimator(const GapOverPlace& gap_rad, bool whole, unsigned seed) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> noise(0.0, sigma_rad);
    records::ReadingTable table;
    table.path = "angles.csv";
    table.axes = {Axis::X, Axis::Y, Axis::Z, Axis::B};
    const double step = rad_from_deg(whole ? 10.0 : 7.5);
    const int first = whole ? 0 : -12, last = whole ? 36 : 12;
    const auto add = [&](int k, int side) {
        records::Reading row;
        row.index = static_cast<int>(table.rows.size());
        row.time_s = 5.0 * row.index;
        row.test = "turns";
        row.commanded[Axis::B] = k * step;
        if (side != 0) {
            row.device = records::Device::angle;
            row.feature = "R1";
            row.angular = true;
            row.direction_M = Vector3(0, 1, 0);
            row.value_mm = 0.5 * side * gap_rad(k * step) + noise(engine);
        }
        table.rows.push_back(row);
    };
    for (int run = 0; run < 4; ++run) {
        add(first - 1, 0);
        for (int k = first; k <= last; ++k) add(k, 1);
        add(last + 1, 0);
        for (int k = last; k >= first; --k) add(k, -1);
    }
    return table;
}

}  // namespace

TEST_CASE("the play of a worm that changes with the angle is a table, and is written",
          "[diagnosis]") {
    const bool whole = GENERATE(true, false);
    const GapOverPlace gap_rad = [&](double at_rad) {
        return 40e-6 + (whole ? 30e-6 * std::cos(at_rad - 0.8)
                              : 60e-6 * std::exp(-0.5 * std::pow((at_rad - 0.3) / 0.45, 2)));
    };
    std::vector<std::string> notes;
    const setup::Setup setup = setup::parse_setup(
        "[machine]\nname = \"m\"\nchain = \"w B b X Y Z t\"\n"
        "[machine.axis.B]\ndirection = [0, 1, 0]\npoint_mm = [0, 0, 0]\n"
        "[[artefact]]\nname = \"R1\"\nkind = \"target\"\ntool_mm = [0, 0, -150]\n"
        "[model]\nmodelled = []\n",
        "s.toml", notes);
    diagnosis::DiagnosisOptions options;
    options.plan_next = false;
    const auto d = diagnosis::diagnose(setup, autocollimator(gap_rad, whole, 3), options);
    INFO(said(d));
    CHECK(d.explained > 0.95);
    for (const diagnosis::Cause& c : d.causes) CHECK(c.effect == "B.backlash");
    const auto play = std::find_if(d.causes.begin(), d.causes.end(),
                                   [](const auto& c) { return !c.points.empty(); });
    REQUIRE(play != d.causes.end());
    CHECK(play->points.front().error == "gap");
    CHECK(play->usual_cause.starts_with("worm"));
    // The written setup read back predicts fresh readings.
    const setup::Setup written =
        setup::parse_setup(setup::format_setup(d.setup), "written.toml", notes);
    const records::ReadingTable fresh = autocollimator(gap_rad, whole, 4);
    const auto predicted =
        emulator::predicted(written, fresh, effects::active_models(written)).rows;
    double squares = 0.0, sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < predicted.size(); ++i) {
        if (!fresh.rows[i].value_mm) continue;
        const double left = *fresh.rows[i].value_mm - *predicted[i].value_mm;
        squares += left * left;
        sum += left;
        ++count;
    }
    CHECK(std::sqrt(squares / count - std::pow(sum / count, 2)) < 1.3 * sigma_rad);
}

}  // namespace trunnion

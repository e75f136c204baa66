// Laser tests of stages as they are: the error changes from target to target, the scatter is far
// from what is usual, and each test has its own zero.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "diagnosis/diagnosis.h"
#include "diagnosis/prepare/prepare.h"
#include "effects/settings.h"
#include "emulator/replay.h"
#include "setup/setup.h"
#include "tests/support/diagnosed.h"
#include "tests/support/laser_lines.h"

namespace trunnion {
namespace {

using laser_lines::stage;

struct Truth {
    std::vector<double> at_mm, error_mm;  ///< mean of both directions at the targets
    double gap_mm = 0.0, noise_mm = 0.0;
};

/// Targets 5 mm apart with independent errors of 30 um, without their mean line, which is a scale.
Truth rough(std::size_t targets, unsigned seed) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> error_mm(0.0, 0.03);
    Truth truth{{}, {}, 0.0128, 0.002};
    for (std::size_t k = 0; k < targets; ++k) {
        truth.at_mm.push_back(5.0 * static_cast<double>(k) - 20.0);
        truth.error_mm.push_back(error_mm(engine));
    }
    const auto n = static_cast<double>(targets);
    double sum = 0.0, along = 0.0, square = 0.0;
    for (const double e_mm : truth.error_mm) sum += e_mm;
    const double middle_mm = 0.5 * (truth.at_mm.front() + truth.at_mm.back());
    for (std::size_t k = 0; k < targets; ++k) {
        along += (truth.at_mm[k] - middle_mm) * truth.error_mm[k];
        square += std::pow(truth.at_mm[k] - middle_mm, 2);
    }
    for (std::size_t k = 0; k < targets; ++k)
        truth.error_mm[k] -= sum / n + along / square * (truth.at_mm[k] - middle_mm);
    return truth;
}

/// Runs up and down over the targets, ISO 230-2.
records::ReadingTable laser(const Truth& truth, int runs, unsigned seed, double zero_mm = 0.0) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> noise(0.0, truth.noise_mm);
    records::ReadingTable table;
    table.path = "laser.csv";
    table.axes = {Axis::X, Axis::Y, Axis::Z};
    table.side_before[index_of(Axis::X)] = -1;
    const auto count = static_cast<int>(truth.at_mm.size());
    for (int k = 0; k < 2 * runs * count; ++k) {
        const int in_run = k % (2 * count), side = in_run < count ? 1 : -1;
        const auto target = static_cast<std::size_t>(side > 0 ? in_run : 2 * count - 1 - in_run);
        records::Reading row;
        row.index = static_cast<int>(table.rows.size());
        row.time_s = 60.0 * row.index;
        if (in_run == 0 || in_run == count) {  // past the end, so that the side is known
            row.commanded[Axis::X] = truth.at_mm[target] - side;
            table.rows.push_back(row);
            row.index += 1;
            row.time_s += 30.0;
        }
        row.commanded[Axis::X] = truth.at_mm[target];
        row.test = "X";
        row.device = records::Device::linear;
        row.feature = "R1";
        row.direction_M = Vector3(1, 0, 0);
        row.value_mm = zero_mm + truth.error_mm[target] + 0.5 * side * truth.gap_mm + noise(engine);
        table.rows.push_back(row);
    }
    return table;
}

const diagnosis::Cause* cause(const diagnosis::Diagnosis& d, const std::string& name, bool table) {
    for (const diagnosis::Cause& c : d.causes)
        if (c.effect == name && c.points.empty() != table) return &c;
    return nullptr;
}

std::string said(const diagnosis::Diagnosis& d) {
    std::string text;
    for (const diagnosis::Cause& c : d.causes)
        text += fmt::format("{}{} {:.2f}; ", c.effect, c.points.empty() ? "" : " table",
                            c.probability.value());
    return text;
}

}  // namespace

TEST_CASE("an error that changes from target to target is a table, and the backlash stays",
          "[diagnosis][stage]") {
    for (const std::size_t targets : {5, 9, 21}) {
        const Truth truth = rough(targets, 7 + static_cast<unsigned>(targets));
        const diagnosis::Diagnosis d = diagnosis::diagnose(stage(), laser(truth, 5, 3));
        INFO(targets);
        INFO(said(d));
        REQUIRE(cause(d, "X.positioning", true));
        CHECK(cause(d, "X.positioning", true)->probability > 0.8);
        const diagnosis::Cause* backlash = cause(d, "X.backlash", false);
        REQUIRE(backlash);
        CHECK(backlash->probability > 0.8);
        CHECK(backlash->parameters.front().value == Approx(0.0128).margin(0.0013));
        CHECK(d.explained > 0.9);
        CHECK_FALSE(d.between_places);

        // At its places the written setup is right, also for a later test with another zero ...
        CHECK(left_beside(d.setup, laser(truth, 3, 99, 0.5)) < 1.15 * truth.noise_mm);
        // ... between them it contains the backlash alone.
        Truth between = truth;
        for (double& at_mm : between.at_mm) at_mm += 2.5;
        for (double& error_mm : between.error_mm) error_mm = 0.0;
        CHECK(left_beside(d.setup, laser(between, 3, 98)) < 1.15 * truth.noise_mm);
    }
}

// The backlash moves the axis by 2.6 % of the way to the next place.
TEST_CASE("a table for places alone is met where the program sends the axis",
          "[diagnosis][stage]") {
    Truth truth = rough(9, 16);
    for (double& at_mm : truth.at_mm) at_mm *= 0.1;
    const diagnosis::Diagnosis d = diagnosis::diagnose(stage(), laser(truth, 5, 3));
    INFO(said(d));
    REQUIRE(cause(d, "X.positioning", true));
    REQUIRE(cause(d, "X.backlash", false));
    CHECK_FALSE(d.between_places);
    CHECK(left_beside(d.setup, laser(truth, 3, 99)) < 1.15 * truth.noise_mm);
}

// Half of the targets of a table that is cut are a ripple of nearly two targets.
TEST_CASE("each of many targets may have an error of its own, which is no ripple",
          "[diagnosis][stage]") {
    for (const std::size_t targets : {28, 36, 60, 128}) {
        const Truth truth = rough(targets, 40 + static_cast<unsigned>(targets));
        const diagnosis::Diagnosis d = diagnosis::diagnose(stage(), laser(truth, 3, 3));
        INFO(targets);
        INFO(said(d));
        REQUIRE(cause(d, "X.positioning", true));
        CHECK(cause(d, "X.positioning", true)->points.size() == targets);
        CHECK_FALSE(cause(d, "X.cyclic", false));
        CHECK(d.explained > 0.8);
        CHECK(left_beside(d.setup, laser(truth, 3, 99)) < 1.25 * truth.noise_mm);
    }
}

TEST_CASE("of more than 128 targets none has an error of its own", "[diagnosis][stage]") {
    const diagnosis::Diagnosis d = diagnosis::diagnose(stage(), laser(rough(129, 5), 2, 3));
    INFO(said(d));
    CHECK(d.verdict != diagnosis::Verdict::no_gap);
    for (const diagnosis::Cause& c : d.causes) CHECK(c.points.size() <= 40);
}

TEST_CASE("one spoiled reading is set aside, and the noise is that of the others",
          "[diagnosis][stage]") {
    const Truth truth = rough(9, 16);
    for (const double off_mm : {0.1, 2.0}) {
        records::ReadingTable table = laser(truth, 4, 3);
        *table.rows[25].value_mm += off_mm;
        const diagnosis::Diagnosis d = diagnosis::diagnose(stage(), table);
        INFO(off_mm);
        INFO(said(d));
        CHECK(d.outliers == 1);
        CHECK(d.noise_um.value() == Approx(1e3 * truth.noise_mm).epsilon(0.3));
        REQUIRE(cause(d, "X.backlash", false));
        CHECK(cause(d, "X.backlash", false)->parameters.front().value ==
              Approx(truth.gap_mm).margin(0.0013));
        CHECK(d.explained > 0.9);
    }
}

// Between cycles the reference moves by ten times what the stage does within one.
TEST_CASE("a zero that moves from cycle to cycle hides neither scale nor backlash",
          "[diagnosis][stage]") {
    Truth truth{{}, {}, -0.002, 0.0002};
    for (int k = 0; k < 11; ++k) {
        truth.at_mm.push_back(40.0 * k);
        truth.error_mm.push_back(10e-6 * truth.at_mm.back());
    }
    records::ReadingTable table = laser(truth, 5, 3);
    const double zero_mm[] = {0.0, 0.006, -0.005, 0.004, -0.007};
    int reading = 0;
    for (records::Reading& row : table.rows)
        if (row.value_mm) *row.value_mm += zero_mm[reading++ / 22];
    const diagnosis::Diagnosis d = diagnosis::diagnose(stage(), table);
    INFO(said(d));
    CHECK(d.noise_um.value() == Approx(0.2).epsilon(0.2));
    REQUIRE(cause(d, "X.scale", false));
    const auto& scale = cause(d, "X.scale", false)->parameters.front();
    CHECK(std::abs(scale.value - 10.0) < 3.0 * scale.sigma);
    REQUIRE(cause(d, "X.backlash", false));
    const auto& gap = cause(d, "X.backlash", false)->parameters.front();
    CHECK(std::abs(gap.value + 0.002) < 3.0 * gap.sigma);
    CHECK(cause(d, "X.backlash", false)->probability > 0.5);
}

// Six readings out of ten are the same: the steps of the indicator, not its repeatability.
TEST_CASE("an indicator is no better than its steps, however well it repeats",
          "[diagnosis][stage]") {
    constexpr double step_mm = 0.01;
    Truth truth{{}, {}, 0.006, 0.0};
    for (int k = 0; k < 11; ++k) {
        truth.at_mm.push_back(40.0 * k);
        truth.error_mm.push_back(40e-6 * truth.at_mm.back());
    }
    records::ReadingTable table = laser(truth, 2, 3);
    for (records::Reading& row : table.rows)
        if (row.value_mm) row.value_mm = step_mm * std::round(*row.value_mm / step_mm);
    const diagnosis::Diagnosis d = diagnosis::diagnose(stage(), table);
    INFO(said(d));
    CHECK(d.noise_um.value() == Approx(1e3 * step_mm / std::sqrt(12.0)).epsilon(0.01));
    REQUIRE(cause(d, "X.scale", false));
    const auto& scale = cause(d, "X.scale", false)->parameters.front();
    CHECK(std::abs(scale.value - 40.0) < 3.0 * scale.sigma);
}

TEST_CASE("the noise of a laser test is that of its own repeats", "[diagnosis][stage]") {
    Truth truth = rough(5, 1);
    for (const double noise_mm : {0.0001, 0.002, 0.02}) {  // usual: 0.0005
        truth.noise_mm = noise_mm;
        const diagnosis::Diagnosis d = diagnosis::diagnose(stage(), laser(truth, 5, 5));
        INFO(noise_mm);
        CHECK(d.noise.source == diagnosis::NoiseSource::repeats);
        CHECK(d.noise_um.value() == Approx(1e3 * noise_mm).epsilon(0.3));
    }
    // One run there and back repeats nothing.
    const diagnosis::Diagnosis once = diagnosis::diagnose(stage(), laser(rough(21, 1), 1, 5));
    CHECK(once.noise.source == diagnosis::NoiseSource::assumed);
}

// What a setup states is the noise of the laser; a stage that does not come back to the same place
// scatters more.
TEST_CASE("repeats measure the noise whatever is stated, and more scatter than that is a gap",
          "[diagnosis][stage]") {
    const setup::Setup stated = stage("noise_um = { linear = 0.4 }\n");
    Truth truth = rough(5, 1);
    truth.gap_mm = 0.05;
    truth.noise_mm = 0.02;
    const diagnosis::Diagnosis rough_one = diagnosis::diagnose(stated, laser(truth, 5, 5));
    INFO(said(rough_one));
    CHECK(rough_one.noise.source == diagnosis::NoiseSource::repeats);
    CHECK(rough_one.noise_um.value() == Approx(20.0).epsilon(0.3));
    REQUIRE(cause(rough_one, "X.backlash", false));
    CHECK(cause(rough_one, "X.backlash", false)->probability > 0.8);
    CHECK_FALSE(rough_one.only_scatter);

    Truth exact{truth.at_mm, std::vector<double>(5, 0.0), 0.0, 0.02};
    for (const double noise_mm : {0.02, 0.0005}) {
        exact.noise_mm = noise_mm;
        const diagnosis::Diagnosis d = diagnosis::diagnose(stated, laser(exact, 5, 6));
        INFO(noise_mm);
        INFO(said(d));
        const bool scatters = noise_mm > 0.01;
        CHECK(d.only_scatter == scatters);
        CHECK((d.verdict == diagnosis::Verdict::no_gap) == !scatters);
        if (!scatters) continue;
        REQUIRE(d.causes.size() == 1);
        CHECK_FALSE(d.causes.front().known);
        CHECK(d.causes.front().probability > 0.95);
        CHECK(d.verdict == diagnosis::Verdict::unexplained);
        // Where nothing is stated, it is the noise.
        CHECK(diagnosis::diagnose(stage(), laser(exact, 5, 6)).verdict ==
              diagnosis::Verdict::no_gap);
    }
}

TEST_CASE("readings held out have a zero of their own", "[diagnosis][stage]") {
    const Truth truth = rough(9, 4);
    const records::ReadingTable fitted = laser(truth, 4, 11);
    std::vector<double> explained;
    for (const double zero_mm : {0.0, 0.02, -1.0, -201.33}) {  // the last: raw values of a counter
        const records::ReadingTable later = laser(truth, 2, 12, zero_mm);
        diagnosis::DiagnosisOptions options;
        options.holdout = &later;
        explained.push_back(diagnosis::diagnose(stage(), fitted, options).explained);
    }
    CHECK(explained[0] > 0.9);
    CHECK(explained[1] == Approx(explained[0]).epsilon(1e-9));
    CHECK(explained[2] == Approx(explained[0]).epsilon(1e-9));
    CHECK(explained[3] == Approx(explained[0]).epsilon(1e-9));
}

TEST_CASE("a spoiled reading held out is told and refutes no cause", "[diagnosis][stage]") {
    const Truth truth = rough(9, 4);
    for (const double off_mm : {0.0, 4.3}) {
        records::ReadingTable later = laser(truth, 2, 12);
        *later.rows[23].value_mm += off_mm;
        diagnosis::DiagnosisOptions options;
        options.holdout = &later;
        options.plan_next = false;
        const diagnosis::Diagnosis d = diagnosis::diagnose(stage(), laser(truth, 4, 11), options);
        INFO(off_mm << ' ' << said(d));
        CHECK(d.explained > 0.9);
        CHECK(d.after.set_aside == (off_mm > 0.0 ? 1 : 0));
        CHECK(d.after.rms_before_um < 100.0);
        CHECK(std::any_of(d.notes.begin(), d.notes.end(), [](const std::string& note) {
                  return note.find("1 held-out readings fit nothing") != std::string::npos;
              }) == (off_mm > 0.0));
    }
}

TEST_CASE("the encoder of a hold-out has a zero of its own", "[diagnosis][stage]") {
    records::ReadingTable log = laser(rough(9, 4), 2, 12);
    for (records::Reading& row : log.rows) {
        if (row.device == records::Device::none) continue;
        row.device = records::Device::axis;
        row.feature = "X";
    }
    const diagnosis::Prepared prepared = diagnosis::prepare(stage(), log);
    for (records::Reading& row : log.rows)
        if (row.value_mm) *row.value_mm += 57.0;
    CHECK_NOTHROW(diagnosis::refuse_poor_holdout(prepared, log));
    *log.rows[23].value_mm += 6.0;
    CHECK_THROWS_WITH(diagnosis::refuse_poor_holdout(prepared, log),
                      Catch::Contains("5.99 mm away"));
}

TEST_CASE("a bow seen at three targets is a table beside the scale", "[diagnosis][stage]") {
    Truth truth{{15.0, 35.0, 55.0}, {0.02, -0.016, -0.025}, 0.0038, 0.0008};
    const diagnosis::Diagnosis d = diagnosis::diagnose(stage(), laser(truth, 10, 8));
    INFO(said(d));
    REQUIRE(cause(d, "X.scale", false));
    // One value beside the line tells the size of the form, and no scale is certain beside that.
    CHECK(cause(d, "X.scale", false)->probability > 0.4);
    CHECK(cause(d, "X.scale", false)->probability < 0.7);
    CHECK(cause(d, "X.positioning", true));
    REQUIRE(cause(d, "X.backlash", false));
    CHECK(cause(d, "X.backlash", false)->parameters.front().value == Approx(0.0038).margin(4e-4));
    CHECK(left_beside(d.setup, laser(truth, 10, 9)) < 1.2 * truth.noise_mm);
}

TEST_CASE("a machine that wanders has a gap, though nothing predicts it", "[diagnosis][stage]") {
    const Truth still{{-20.0, -10.0, 0.0, 10.0, 20.0}, {0.0, 0.0, 0.0, 0.0, 0.0}, 0.0, 0.0005};
    for (const unsigned seed : {1u, 2u, 3u}) {
        records::ReadingTable table = laser(still, 6, seed);
        std::mt19937_64 engine(seed + 100);
        std::normal_distribution<double> step_mm(0.0, 0.002);
        double off_mm = 0.0;
        for (records::Reading& row : table.rows) {
            off_mm += step_mm(engine);
            if (row.value_mm) row.value_mm = *row.value_mm + off_mm;
        }
        const diagnosis::Diagnosis d =
            diagnosis::diagnose(stage("noise_um = { linear = 0.5 }\n"), table);
        INFO(said(d));
        CHECK(d.verdict != diagnosis::Verdict::no_gap);
        for (const diagnosis::Cause& c : d.causes)
            if (c.effect != "thermal.drift" && c.effect != "unknown") CHECK(c.probability < 0.9);
    }
}

TEST_CASE("a spike is not seen by a laser between moves", "[diagnosis][stage]") {
    const Truth truth{
        {-200.0, -100.0, 0.0, 100.0, 200.0}, {0.0, 0.0, 0.0, 0.0, 0.0}, 0.008, 0.0004};
    const diagnosis::Diagnosis d = diagnosis::diagnose(stage(), laser(truth, 5, 6));
    INFO(said(d));
    CHECK(d.verdict == diagnosis::Verdict::explained);
    REQUIRE(d.causes.size() == 1);
    CHECK(d.causes.front().effect == "X.backlash");
    CHECK(d.causes.front().rivals.empty());
}

TEST_CASE("a table without interpolation is written and read again", "[diagnosis][stage]") {
    const Truth truth = rough(5, 2);
    const diagnosis::Diagnosis d = diagnosis::diagnose(stage(), laser(truth, 5, 3));
    std::vector<std::string> notes;
    const setup::Setup again =
        setup::parse_setup(setup::format_setup(d.setup), "again.toml", notes);
    const records::ReadingTable later = laser(truth, 2, 20);
    CHECK(left_beside(again, later) == Approx(left_beside(d.setup, later)).epsilon(1e-9));
    CHECK(setup::format_setup(d.setup).find("interpolation = \"none\"") != std::string::npos);
}

}  // namespace trunnion

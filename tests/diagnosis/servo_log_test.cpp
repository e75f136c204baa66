// A servo log of a single test: lag is named; zeros that scatter between tests are told, not
// claimed.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <utility>

#include "base/units.h"
#include "diagnosis/diagnosis.h"
#include "effects/settings.h"
#include "emulator/replay.h"
#include "tests/support/diagnosed.h"
#include "tests/support/said.h"

namespace trunnion {
namespace {

setup::Setup machine() {
    std::vector<std::string> notes;
    return setup::parse_setup(
        "[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n"
        "[machine.axis.X]\ndirection = [1, 0, 0]\n"
        "[model]\nmodelled = []\nnoise_um = { axis = 1 }\n",
        "s.toml", notes);
}

/// X as a PC samples it, 100 times a second, on a way without a period.
records::ReadingTable log(const std::string& test, std::size_t count, double phase) {
    records::ReadingTable table;
    table.path = "log.csv";
    table.axes = {Axis::X, Axis::Y, Axis::Z};
    for (std::size_t k = 0; k < count; ++k) {
        records::Reading row;
        row.index = static_cast<int>(k);
        row.time_s = 0.01 * static_cast<double>(k);
        row.test = test;
        row.device = records::Device::axis;
        row.feature = "X";
        row.commanded[Axis::X] = 40.0 * std::sin(1.3 * row.time_s + phase) +
                                 9.0 * std::sin(3.1 * row.time_s + 2.0 * phase);
        table.rows.push_back(row);
    }
    return table;
}

/// The values of `real` with noise of 1 um from a generator of its own.
records::ReadingTable measured(const setup::Setup& real, const records::ReadingTable& table,
                               unsigned seed) {
    records::ReadingTable read = emulator::predicted(real, table, effects::active_models(real));
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> noise(0.0, 1e-3);
    for (records::Reading& row : read.rows) *row.value_mm += noise(engine);
    return read;
}

/// Steady response of a loop 1 / (1 + T s + c s^2) to the oval, known in closed form, minus the
/// command.
double following_mm(double size_mm, double w, double phase, const double (&loop)[2]) {
    const double real = 1.0 - loop[1] * w * w, imaginary = loop[0] * w;
    return size_mm * (std::sin(phase - std::atan2(imaginary, real)) / std::hypot(real, imaginary) -
                      std::sin(phase));
}

/// X and Y on ovals, 100 times a second; each test begins at a reversal of Y. `loop`: T (s) and
/// c (s^2) of X and of Y.
records::ReadingTable ovals(const double (&loop)[2][2], std::mt19937_64& engine) {
    std::normal_distribution<double> noise(0.0, 3e-4);
    std::uniform_real_distribution<double> amplitude_mm(20.0, 60.0), hz(0.3, 1.0);
    records::ReadingTable all = log("", 0, 0.0);
    for (int test = 0; test < 5; ++test) {
        const double w = 2.0 * pi * hz(engine);
        const double size_mm[] = {amplitude_mm(engine), amplitude_mm(engine)};
        for (int k = 0; k < 600; ++k) {
            const double phase[] = {w * 0.01 * (k / 2), w * 0.01 * (k / 2) + pi / 2};
            const int axis = k % 2;
            records::Reading row;
            row.index = static_cast<int>(all.rows.size());
            row.time_s = 10.0 * test + 0.01 * (k / 2);
            row.test = "t" + std::to_string(test);
            row.device = records::Device::axis;
            row.feature = axis == 0 ? "X" : "Y";
            row.commanded[Axis::X] = size_mm[0] * std::sin(phase[0]);
            row.commanded[Axis::Y] = size_mm[1] * std::sin(phase[1]);
            row.value_mm = following_mm(size_mm[axis], w, phase[axis], loop[axis]) + noise(engine);
            all.rows.push_back(row);
        }
    }
    return all;
}

}  // namespace

TEST_CASE("what an encoder counts from is set-up: the lag beside it has its size, and it is told",
          "[diagnosis][servo]") {
    const double zero_mm = GENERATE(-0.3, 0.003, 2.0);
    const double lag_s = GENERATE(0.0, 0.004);
    setup::Setup real = machine();
    real.effects = {{"servo.mismatch", {{"tau_x_s", {lag_s}}}}};
    records::ReadingTable table = measured(real, log("test", 1000, 0.3), 5);
    for (records::Reading& row : table.rows) *row.value_mm += zero_mm;
    diagnosis::DiagnosisOptions options;
    options.plan_next = false;
    const diagnosis::Diagnosis d = diagnosis::diagnose(machine(), table, options);
    INFO(zero_mm << " mm, " << lag_s << " s: " << said(d));
    if (lag_s == 0.0) {
        CHECK(d.verdict == diagnosis::Verdict::no_gap);
    } else {
        REQUIRE(!d.causes.empty());
        CHECK(d.verdict == diagnosis::Verdict::explained);
        CHECK(d.causes.front().effect == "servo.mismatch");
        CHECK(d.causes.front().parameters.front().value == Approx(lag_s).epsilon(0.01));
    }
    REQUIRE(d.set_up_words.size() == 1);
    CHECK_THAT(d.set_up_words.front(),
               Catch::StartsWith("X is read ") &&
                   Catch::EndsWith("beside its commanded position in all rows"));
    CHECK(d.setup.encoder_zero[index_of(Axis::X)] == Approx(zero_mm).margin(2e-4));
    // The written setup knows it: a later log has no gap and no zero.
    std::vector<std::string> notes;
    const setup::Setup written =
        setup::parse_setup(setup::format_setup(d.setup), "written.toml", notes);
    const diagnosis::Diagnosis again = diagnosis::diagnose(written, table, options);
    CHECK(again.verdict == diagnosis::Verdict::no_gap);
    CHECK(again.rms_um == Approx(1.0).epsilon(0.1));
}

TEST_CASE("no control rounds by many times its increment, whatever this would explain",
          "[diagnosis][servo]") {
    // The quantisation of a coarse encoder, 40 times the rounding of the command, and a creep.
    records::ReadingTable table = log("test", 1000, 0.3);
    std::mt19937_64 engine(11);
    std::normal_distribution<double> noise(0.0, 5e-4);
    for (records::Reading& row : table.rows) {
        const double x = row.commanded[Axis::X], step = 0.002;
        row.value_mm = 40.0 * (std::round(x / step) * step - x) + noise(engine);
    }
    diagnosis::DiagnosisOptions options;
    options.plan_next = false;
    const diagnosis::Diagnosis d = diagnosis::diagnose(machine(), table, options);
    INFO(said(d));
    CHECK(d.verdict != diagnosis::Verdict::no_gap);
    for (const diagnosis::Cause& cause : d.causes) CHECK(cause.effect != "control.rounding");
}

// The last digit of the log is the only noise that is known, and friction leaves 50 times that.
TEST_CASE("a lag of tens of milliseconds is named in a log whose noise nobody states",
          "[diagnosis]") {
    std::vector<std::string> notes;
    const setup::Setup one = setup::parse_setup(
        "[machine]\nname = \"m\"\nchain = \"w b X t\"\n"
        "[machine.axis.X]\ndirection = [1, 0, 0]\n[model]\nmodelled = []\n",
        "s.toml", notes);
    for (const double lag_s : {0.008, 0.03, 0.06}) {
        records::ReadingTable read = log("log", 400, 0.7);
        double before = read.rows.front().commanded[Axis::X];
        double speed = 0.0, rub_mm = 0.0;
        for (records::Reading& row : read.rows) {
            const double q = row.commanded[Axis::X];
            speed = (std::exchange(before, q) - q) / -0.01;
            // Friction that grows from nothing to its size within some millimetres.
            rub_mm += 0.2 * (0.25 * std::tanh(speed / 20.0) - rub_mm);
            const double t = row.time_s - lag_s;
            const double late = 40.0 * std::sin(1.3 * t + 0.7) + 9.0 * std::sin(3.1 * t + 1.4);
            row.value_mm = std::round((late - rub_mm) / 1e-3) * 1e-3 - q;
        }
        const diagnosis::Diagnosis d = diagnosis::diagnose(one, read);
        INFO(lag_s << " s: " << said(d));
        REQUIRE(!d.causes.empty());
        CHECK(d.causes.front().effect == "servo.mismatch");
        CHECK(d.causes.front().probability > 0.7);
        for (const std::string& rival : d.causes.front().rivals)
            CHECK(rival != "readings.mistaken");
        CHECK(d.verdict != diagnosis::Verdict::unexplained);
    }
}

TEST_CASE("the lag of one recording is named, and nothing else", "[diagnosis]") {
    const setup::Setup setup = machine();
    setup::Setup real = setup;
    real.effects.push_back({"servo.mismatch", {{"tau_x_s", {0.008}}}});
    const auto d = diagnosis::diagnose(setup, measured(real, log("log", 900, 0.4), 1), {});
    CHECK(d.verdict == diagnosis::Verdict::explained);
    REQUIRE(d.causes.size() == 1);
    CHECK(d.causes[0].effect == "servo.mismatch");
    CHECK(d.causes[0].parameters[0].value == Approx(0.008).epsilon(0.05));
}

TEST_CASE("one recording without a gap is told as such", "[diagnosis]") {
    const setup::Setup setup = machine();
    const auto d = diagnosis::diagnose(setup, measured(setup, log("log", 900, 0.4), 2), {});
    CHECK(d.verdict == diagnosis::Verdict::no_gap);
    CHECK(d.causes.empty());
}

TEST_CASE("zeros that scatter less than the noise stand in the set-up with their size",
          "[diagnosis]") {
    const setup::Setup setup = machine();
    std::mt19937_64 engine(3);
    std::normal_distribution<double> zero(0.0, 0.8e-3);
    records::ReadingTable all = log("t0", 0, 0.0);
    double square = 0.0;
    constexpr int tests = 16;
    for (int t = 0; t < tests; ++t) {
        records::ReadingTable one =
            measured(setup, log("t" + std::to_string(t), 60, 0.37 * t), 10U + unsigned(t));
        const double offset_mm = zero(engine);
        square += offset_mm * offset_mm / tests;
        for (records::Reading& row : one.rows) {
            *row.value_mm += offset_mm;
            row.time_s += 10.0 * t;
            row.index = static_cast<int>(all.rows.size());
            all.rows.push_back(row);
        }
    }
    const auto d = diagnosis::diagnose(setup, all, {});
    CHECK(d.causes.empty());
    double found_mm = 0.0;
    for (const auto& p : d.set_up)
        if (p.name == "scatter of the zero of a pass") found_mm = p.value;
    CHECK(found_mm == Approx(std::sqrt(square)).epsilon(0.25));
}

TEST_CASE("the lag of a loop is mismatch and contour: no spike, no gain beside it", "[diagnosis]") {
    const setup::Setup setup = machine();
    std::uniform_real_distribution<double> lag_s(4e-3, 12e-3);
    for (const unsigned seed : {1u, 2u, 3u, 4u}) {
        std::mt19937_64 engine(seed);
        const bool second_order = seed % 2 == 0;
        double loop[2][2];
        for (auto& [lag, square] : loop) {
            lag = lag_s(engine);
            square = second_order ? 0.5 * lag * lag : 0.0;
        }
        diagnosis::DiagnosisOptions options;
        options.plan_next = false;
        const auto d = diagnosis::diagnose(setup, ovals(loop, engine), options);
        INFO(said(d));
        const bool named = d.verdict == diagnosis::Verdict::explained ||
                           d.verdict == diagnosis::Verdict::ambiguous;
        CHECK(named);
        REQUIRE(d.causes.size() == 2);
        CHECK(d.causes[0].effect == "servo.mismatch");
        CHECK(d.causes[1].effect == "servo.contour");
        for (std::size_t axis : {0u, 1u}) {
            const auto& [lag, square] = loop[axis];
            const auto& p = d.causes[0].parameters[axis];
            // Nothing tells the motion before a log that begins within it.
            CHECK(std::abs(p.value - lag) < 4.0 * p.sigma + 1e-6);
            CHECK(p.sigma < 1e-6);
            CHECK(d.causes[1].parameters[axis].value == Approx(lag * lag - square).epsilon(0.02));
        }
        CHECK(d.after_rms_um < 0.5);
    }
}

// A scope that caught one move: most of it lies in one part of the log.
TEST_CASE("the lag of a single move is written, beside the noise that the axis has at rest",
          "[diagnosis]") {
    std::vector<std::string> notes;
    const setup::Setup usual = setup::parse_setup(
        "[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n[model]\nmodelled = []\n", "s.toml",
        notes);
    setup::Setup real = usual;
    real.effects.push_back({"servo.mismatch", {{"tau_x_s", {0.03}}}});
    const auto move = [&](double length_mm, double rest_s, unsigned seed) {
        records::ReadingTable table = log("scope", 140, 0.0);
        for (records::Reading& row : table.rows) {
            const double part = std::clamp((row.time_s - rest_s) / 0.6, 0.0, 1.0);
            row.commanded[Axis::X] = length_mm * (part - std::sin(2.0 * pi * part) / (2.0 * pi));
        }
        records::ReadingTable read = emulator::predicted(real, table, effects::active_models(real));
        std::mt19937_64 engine(seed);
        std::normal_distribution<double> noise(0.0, 0.07);
        for (records::Reading& row : read.rows) *row.value_mm += noise(engine);
        return read;
    };
    for (unsigned seed = 1; seed <= 3; ++seed) {
        const diagnosis::Diagnosis d = diagnosed(usual, move(60.0, 0.3, seed));
        INFO(seed << ": " << said(d));
        CHECK(d.noise_um.value() == Approx(70.0).epsilon(0.3));
        const records::ReadingTable other = move(-25.0, 0.5, 99);
        CHECK(left_beside(d.setup, other) < 0.1);
        CHECK(left_beside(usual, other) > 0.5);
    }
}

namespace {

/// X on moves of trapezoidal speed, each followed by a short rest, behind a loop of first order
/// with a dead time: simulated ten times between two rows.
records::ReadingTable moves_behind(double time_constant_s, double dead_s, unsigned seed) {
    constexpr double row_s = 0.004, step_s = row_s / 10.0, speed = 40.0, acceleration = 1500.0;
    std::mt19937_64 engine(seed);
    std::uniform_real_distribution<double> length_mm(-60.0, 60.0);
    std::normal_distribution<double> noise(0.0, 1e-3);
    std::vector<double> commanded(250, 0.0);
    while (commanded.size() < 12000) {
        const double from = commanded.back(), way = length_mm(engine) - from;
        const double top = std::min(speed, std::sqrt(std::abs(way) * acceleration));
        const double up_s = top / acceleration, all_s = std::abs(way) / top + up_s;
        for (double t = step_s; t < all_s; t += step_s) {
            const double a = std::min(t, up_s), b = std::max(0.0, t - (all_s - up_s));
            const double gone = 0.5 * acceleration * (a * a - b * b) +
                                top * (std::max(0.0, t - up_s) - b) + top * b;
            commanded.push_back(from + std::copysign(gone, way));
        }
        commanded.insert(commanded.end(), 300, from + way);
    }
    records::ReadingTable table = log("moves", 0, 0.0);
    const auto late = static_cast<std::size_t>(std::lround(dead_s / step_s));
    double actual = 0.0;
    for (std::size_t k = 0; k < commanded.size(); ++k) {
        const auto goal_at = [&](std::size_t i) {
            return i < late ? commanded[0] : commanded[i - late];
        };
        const double goal = 0.5 * (goal_at(k) + goal_at(std::max<std::size_t>(k, 1) - 1));
        actual += (goal - actual) * -std::expm1(-step_s / time_constant_s);
        if (k % 10 != 0) continue;
        records::Reading row;
        row.index = static_cast<int>(table.rows.size());
        row.time_s = step_s * static_cast<double>(k);
        row.test = "moves";
        row.device = records::Device::axis;
        row.feature = "X";
        row.commanded[Axis::X] = commanded[k];
        row.value_mm = actual - commanded[k] + noise(engine);
        table.rows.push_back(row);
    }
    return table;
}

}  // namespace

TEST_CASE("a loop answers to moves with jumps of acceleration by its time constant",
          "[diagnosis][servo]") {
    const double seconds = GENERATE(0.01, 0.04, 0.1, 0.2);
    const double dead_s = GENERATE(0.0, 0.002);
    const diagnosis::Diagnosis d = diagnosed(machine(), moves_behind(seconds, dead_s, 3));
    INFO(seconds << " s, " << dead_s << " s: " << said(d));
    // Orders of a lag that is longer than the moves cancel each other: no claim, but the same size.
    if (seconds < 0.15) CHECK(d.verdict == diagnosis::Verdict::explained);
    REQUIRE(!d.causes.empty());
    CHECK(d.causes[0].effect == "servo.mismatch");
    CHECK(d.causes[0].parameters[0].value == Approx(seconds + dead_s).epsilon(0.01));
    // The orders beside it answer for what a near one leaves.
    CHECK(d.setup.time_constant_s[index_of(Axis::X)] ==
          Approx(seconds).margin(0.2 * seconds + 2.0 * dead_s));
    // Other moves are predicted nearly to their noise of 1 um; a series of derivatives leaves
    // 40 um and more.
    std::vector<std::string> notes;
    const setup::Setup written =
        setup::parse_setup(setup::format_setup(d.setup), "written.toml", notes);
    CHECK(left_beside(written, moves_behind(seconds, dead_s, 4)) < (dead_s > 0.0 ? 8e-3 : 2e-3));
}

// Nothing is wrong with a control whose encoder has steps.
TEST_CASE("an encoder of coarse steps is no control that rounds", "[diagnosis]") {
    constexpr double step_mm = 0.01;
    records::ReadingTable table = log("a", 1500, 0.3);
    for (records::Reading& row : table.rows) {
        double& at_mm = row.commanded[Axis::X];
        at_mm = std::round(1e6 * at_mm) / 1e6;
        row.value_mm = step_mm * std::round(at_mm / step_mm) - at_mm;
    }
    const diagnosis::Diagnosis d = diagnosis::diagnose(machine(), table);
    INFO(said(d));
    CHECK(d.verdict == diagnosis::Verdict::no_gap);
    CHECK(d.noise_um.value() == Approx(1e3 * step_mm / std::sqrt(12.0)).epsilon(0.1));
}

// Neither the setup nor repeats tell the noise: what comes and goes over many rows is none.
TEST_CASE("what a log shows of the position is a gap, and noise is none, whatever its size",
          "[diagnosis][servo]") {
    std::vector<std::string> notes;
    const setup::Setup setup = setup::parse_setup(
        "[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n[model]\nmodelled = []\n", "s.toml",
        notes);
    const double error_mm = GENERATE(0.0, 0.008);
    const double period_mm = GENERATE(7.0, 60.0);
    std::mt19937_64 engine(11);
    std::normal_distribution<double> noise(0.0, 3e-3);
    records::ReadingTable table = log("test", 1200, 0.7);
    for (records::Reading& row : table.rows)
        row.value_mm = noise(engine) +
                       error_mm * std::sin(2.0 * pi * row.commanded[Axis::X] / period_mm + 1.0);
    const diagnosis::Diagnosis d = diagnosed(setup, table);
    INFO(error_mm << " mm, " << period_mm << " mm: " << said(d));
    if (error_mm == 0.0) {
        CHECK(d.verdict == diagnosis::Verdict::no_gap);
        return;
    }
    CHECK(d.verdict == diagnosis::Verdict::unexplained);
    REQUIRE(!d.causes.empty());
    CHECK(d.causes.front().effect == "unknown");
    CHECK(d.noise_um < 5.0);
    if (period_mm > 50.0) CHECK_THAT(d.causes.front().what, Catch::Contains("position of X"));
}

}  // namespace trunnion

// A servo log of a single test: lag is named; zeros that scatter between tests are told, not
// claimed.
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "diagnosis/diagnosis.h"
#include "effects/settings.h"
#include "emulator/replay.h"

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

}  // namespace

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

}  // namespace trunnion

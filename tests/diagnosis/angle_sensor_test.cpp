// Angle sensors: an error of one harmonic is named by its order, one of many is followed as far as
// the places tell them.
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "base/units.h"
#include "tests/support/diagnosed.h"
#include "tests/support/said.h"

namespace trunnion {
namespace {

setup::Setup sensor(double sense) {
    std::vector<std::string> notes;
    return setup::parse_setup(
        "[machine]\nname = \"s\"\nchain = \"w b C t\"\n"
        "[machine.axis.C]\ndirection = [0, 0, " +
            std::to_string(sense) +
            "]\npoint_mm = [0, 0, 0]\n"
            "[[artefact]]\nname = \"R1\"\nkind = \"target\"\n"
            "tool_mm = [0, 0, 0]\n"
            "[model]\nmodelled = []\nnoise_urad = { angle = 0.5 }\n",
        "s.toml", notes);
}

/// One turn in even steps; the error counts with the angle of the axis, whatever its sense.
template <typename ErrorAt>
records::ReadingTable turn(int places, double sense, unsigned seed, const ErrorAt& error_at) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> noise(0.0, 0.5e-6);
    records::ReadingTable table;
    table.path = "turn.csv";
    table.axes = {Axis::C};
    for (int k = 0; k < places; ++k) {
        records::Reading row;
        row.index = k;
        row.time_s = 5.0 * k;
        row.test = "turn";
        row.device = records::Device::angle;
        row.feature = "R1";
        row.angular = true;
        row.direction_M = sense * Vector3::UnitZ();
        row.commanded[Axis::C] = 2.0 * pi * k / places;
        row.value_mm = error_at(row.commanded[Axis::C]) + noise(engine);
        table.rows.push_back(row);
    }
    return table;
}

}  // namespace

TEST_CASE("one harmonic of an angle sensor is named by its order", "[diagnosis]") {
    const double sense = GENERATE(1.0, -1.0);
    const diagnosis::Diagnosis d =
        diagnosed(sensor(sense),
                  turn(72, sense, 1, [](double q) { return 70.9e-6 * std::cos(4.0 * (q - 0.3)); }));
    INFO(said(d));
    REQUIRE(d.causes.size() == 1);
    const diagnosis::Cause& cause = d.causes.front();
    CHECK(cause.effect == "C.positioning");
    CHECK(cause.points.empty());
    REQUIRE(cause.parameters.size() == 2);
    CHECK(cause.parameters[0].name == "cos4_rad");
    CHECK(cause.parameters[0].value == Approx(70.9e-6 * std::cos(1.2)).margin(0.5e-6));
    CHECK(cause.parameters[1].value == Approx(70.9e-6 * std::sin(1.2)).margin(0.5e-6));
    CHECK(cause.parameters[0].sigma == Approx(0.5e-6 * std::sqrt(2.0 / 72.0)).epsilon(0.4));
    CHECK_THAT(cause.what, Catch::Contains("order 4") && Catch::Contains("17.2 deg"));
}

TEST_CASE("one harmonic is named where a part of the turn shows its periods", "[diagnosis]") {
    const double span_deg = GENERATE(180.0, 284.0);
    records::ReadingTable table =
        turn(80, 1.0, 1, [&](double q) { return 100e-6 * std::sin(4.0 * q * span_deg / 360.0); });
    for (records::Reading& row : table.rows) row.commanded[Axis::C] *= span_deg / 360.0;
    const diagnosis::Diagnosis d = diagnosed(sensor(1.0), table);
    INFO(span_deg << ": " << said(d));
    REQUIRE(!d.causes.empty());
    CHECK(d.causes.front().effect == "C.positioning");
    CHECK_THAT(d.causes.front().what, Catch::Contains("order 4"));
    for (std::size_t k = 1; k < d.causes.size(); ++k) CHECK(d.causes[k].probability < 0.5);
}

TEST_CASE("the harmonics of an angle sensor are followed as far as its places tell them",
          "[diagnosis]") {
    // A disc that is wrong at every scale: beyond order 24 there are 2.2 urad.
    const auto error_at = [](double q) {
        double sum = 0.0;
        for (int n = 1; n <= 60; ++n) sum += 20e-6 / n * std::cos(n * q + n * n);
        return sum;
    };
    const diagnosis::Diagnosis d = diagnosed(sensor(1.0), turn(180, 1.0, 2, error_at));
    INFO(said(d));
    CHECK(d.verdict == diagnosis::Verdict::explained);
    CHECK(left_beside(d.setup, turn(200, 1.0, 3, error_at)) < 1.0e-6);
}

}  // namespace trunnion

// What outside judges found where one axis stands beside another, or passes have zeros of their
// own.
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "base/units.h"
#include "tests/support/diagnosed.h"
#include "tests/support/said.h"

namespace trunnion {
namespace {

setup::Setup machine_of(const std::string& chain) {
    std::vector<std::string> notes;
    std::string text = "[machine]\nname = \"m\"\nchain = \"" + chain + "\"\n";
    if (chain.find('C') != std::string::npos)
        text += "[machine.axis.C]\ndirection = [0, 0, -1]\npoint_mm = [0, 0, 0]\n";
    text +=
        "[[artefact]]\nname = \"R1\"\nkind = \"target\"\ntool_mm = [0, 0, -100]\n"
        "[model]\nmodelled = []\nnoise_um = { linear = 1.0 }\nnoise_urad = { angle = 5.0 }\n";
    return setup::parse_setup(text, "m.toml", notes);
}

/// Readings in turn, 5 s apart, all other axes at zero.
struct Course {
    records::ReadingTable table;

    explicit Course(std::vector<Axis> axes) {
        table.path = "m.csv";
        table.axes = std::move(axes);
    }

    records::Reading& move(const std::string& test, Axis axis, double at) {
        records::Reading row;
        row.index = static_cast<int>(table.rows.size());
        row.time_s = 5.0 * row.index;
        row.test = test;
        for (const Axis other : table.axes) row.commanded[other] = 0.0;
        row.commanded[axis] = at;
        table.rows.push_back(row);
        return table.rows.back();
    }

    void read(const std::string& test, Axis axis, double at, double value) {
        records::Reading& row = move(test, axis, at);
        row.angular = is_rotary(axis);
        row.device = row.angular ? records::Device::angle : records::Device::linear;
        row.feature = "R1";
        row.direction_M = row.angular ? Vector3(0, 0, -1) : Vector3(Vector3::UnitX());
        row.value_mm = value;
    }
};

/// Some um, over 480 mm.
double curve_mm(double x_mm, double phase) {
    const double x = x_mm / 480.0;
    return 3.0e-3 * std::sin(pi * 2.0 * x + phase) + 1.5e-3 * std::sin(pi * 3.0 * x + 2.0 * phase);
}

/// A laser over X, and a calibration of C, whose error of 0.3 mrad is far above its noise.
records::ReadingTable laser_and_table(unsigned seed) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> noise(0.0, 1.0);
    Course course({Axis::X, Axis::C});
    for (int pass = 0; pass < 4; ++pass)
        for (int k = 0; k < 13; ++k) {
            const double at = 40.0 * (pass % 2 == 0 ? k : 12 - k);
            course.read("x", Axis::X, at, curve_mm(at, seed) + 1e-3 * noise(engine));
        }
    for (int pass = 0; pass < 2; ++pass)
        for (int k = 0; k < 36; ++k) {
            const double at = rad_from_deg(10.0 * (pass == 0 ? k : 35 - k));
            const double error = std::sin(at + seed) + 0.8 * std::sin(5.0 * at + 1.0) +
                                 0.6 * std::sin(9.0 * at + 2.0);
            course.read("c", Axis::C, at, 300e-6 * error + 5e-6 * noise(engine));
        }
    return course.table;
}

/// Passes of 21 targets, each with a zero of its own and without any play.
records::ReadingTable passes(const std::vector<int>& sides, double zero_mm, double play_mm,
                             unsigned seed) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> noise(0.0, 1.0);
    Course course({Axis::X});
    for (const int side : sides) {
        const double zero = zero_mm * noise(engine);
        course.move("x", Axis::X, side > 0 ? -10.0 : 410.0);
        for (int k = 0; k < 21; ++k)
            course.read("x", Axis::X, 20.0 * (side > 0 ? k : 20 - k),
                        zero + 0.5 * side * play_mm + 1e-3 * noise(engine));
    }
    return course.table;
}

}  // namespace

TEST_CASE("a table of one axis is written beside an error of another one", "[diagnosis][judged]") {
    const unsigned seed = GENERATE(1u, 2u, 3u);
    const setup::Setup setup = machine_of("w C b X t");
    const diagnosis::Diagnosis d = diagnosed(setup, laser_and_table(seed));
    INFO(seed << ": " << said(d));
    Course elsewhere({Axis::X, Axis::C});
    for (double at = 7.0; at < 480.0; at += 11.0)
        elsewhere.read("x", Axis::X, at, curve_mm(at, seed));
    CHECK(left_beside(setup, elsewhere.table) > 1.5e-3);
    CHECK(left_beside(d.setup, elsewhere.table) < 0.8e-3);
}

TEST_CASE("a play is no more certain than its few passes with zeros of their own",
          "[diagnosis][judged]") {
    const setup::Setup setup = machine_of("w b X t");
    int certain = 0;
    for (unsigned seed = 1; seed <= 20; ++seed) {
        const diagnosis::Diagnosis d = diagnosed(setup, passes({-1, -1, 1}, 5e-3, 0.0, seed));
        if (probability_of(d, "X.backlash") >= 0.9) ++certain;
    }
    CHECK(certain <= 5);  // 15 by their readings alone
}

TEST_CASE("a play is claimed beside zeros of passes that wander less", "[diagnosis][judged]") {
    const setup::Setup setup = machine_of("w b X t");
    const unsigned seed = GENERATE(1u, 2u, 3u, 4u);
    const double zero_mm = GENERATE(0.0, 3e-3);
    const diagnosis::Diagnosis d =
        diagnosed(setup, passes({1, -1, 1, -1, 1, -1, 1, -1, 1, -1}, zero_mm, 12e-3, seed));
    INFO(seed << ", " << zero_mm << " mm: " << said(d));
    CHECK(probability_of(d, "X.backlash") >= 0.9);
}

}  // namespace trunnion

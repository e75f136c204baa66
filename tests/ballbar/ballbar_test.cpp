#include "ballbar/ballbar.h"

#include <catch2/catch.hpp>

#include "base/units.h"

using namespace trunnion;

TEST_CASE("length deviation on a circle shows centre offset and scale") {
    kinematics::Machine machine;
    machine.chain = kinematics::parse_chain("w b X Y Z t");
    machine.errors.motion({'X', false, Axis::X}).slope = 1e-5;
    const ballbar::Ballbar bar{Vector3(0, 0, -120), Vector3(0.01, 0, -120), 100.0, 1.0};
    for (double t = 0; t < 2 * pi; t += 0.1) {
        AxisPositions q;
        q[Axis::X] = 100 * std::cos(t), q[Axis::Y] = 100 * std::sin(t);
        const double c = std::cos(t);
        CHECK(ballbar::length_deviation_mm(machine.poses(q), bar) ==
              Approx(1e-3 * c * c - 0.01 * c).margin(1e-6));
        CHECK(ballbar::cup_to_pivot_M(machine.poses(q), bar).x() ==
              Approx(0.01 - 100 * c * (1 + 1e-5)).margin(1e-9));
    }
    CHECK(ballbar::in_range(-1.0, bar));
    CHECK_FALSE(ballbar::in_range(1.0001, bar));
}

TEST_CASE("samples are taken once, whatever the moves between which they fall") {
    const auto whole = ballbar::sample_times(2.0, 1000.0, 2.0, 5.0);
    CHECK(whole.size() == 3000);
    std::vector<double> parts;
    double from = 2.0;
    for (const double to : {2.1, 2.1005, 3.333, 3.3331, 4.0, 5.0}) {
        for (const double t : ballbar::sample_times(2.0, 1000.0, from, to)) parts.push_back(t);
        from = to;
    }
    CHECK(parts == whole);
}

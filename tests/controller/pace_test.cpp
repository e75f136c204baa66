// Cycle time of blocks: feeds, rapids, axis speeds and accelerations, exact stop and corners.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "base/units.h"
#include "block_bench.h"
#include "motion/path_rates.h"

namespace trunnion {

using bench::Bench;

namespace {

constexpr double a_x = 1000.0, a_y = 500.0;  // mm/s^2
constexpr double v_x = 200.0, v_y = 300.0;   // mm/s

/// X and Y differ, Z is as X; B and C 90 deg/s and 400 deg/s^2.
controller::ControlConfig axes() {
    controller::ControlConfig config = bench::five_axes();
    for (controller::ControlAxis& axis : config.axes) {
        axis.rapid_speed = axis.rotary ? pi / 2 : axis.axis == Axis::Y ? v_y : v_x;
        axis.max_acceleration = axis.rotary            ? rad_from_deg(400.0)
                                : axis.axis == Axis::Y ? a_y
                                                       : a_x;
    }
    return config;
}

struct Timed : Bench {
    explicit Timed(controller::ControlConfig config = axes()) : Bench(std::move(config)) {
        offsets::Parameters& p = stores.parameters;
        p.set(3401, 1);
        p.set(1783, 600);  // 10 mm/s, 10 deg/s
        for (const auto& [number, value] : {std::pair{19680, 12},
                                            {19681, 4},
                                            {19682, 2},
                                            {19684, 1},
                                            {19686, 5},
                                            {19687, 3},
                                            {19689, 1}})
            p.set(number, value);
        stores.tools.tool[1].length_geometry_mm = 100.0;
        control.parameters_changed();
        (*this)("G90 G21 G17 G94 G54 G64 G40");
    }
    /// Seconds that these blocks take.
    double operator[](const std::string& program) {
        control.mover.axes.stop();
        const double before = control.mover.record().time_s;
        (*this)(program);
        return control.mover.record().time_s - before;
    }
};

}  // namespace

TEST_CASE("G1: the closed forms of a long and of a short move") {
    const double f = 50.0;
    CHECK(Timed()["G1 X100. F3000."] == Approx(100 / f + f / a_x));
    CHECK(Timed()["G1 X1. F3000."] == Approx(2 * std::sqrt(1 / a_x)));  // needs 2.5 mm
    CHECK(Timed()["G1 X2.5 F3000."] == Approx(2 * f / a_x));
    // Along X 30 Y 40 of 50: Y's 500 mm/s^2 allow 625 along the path.
    CHECK(Timed()["G1 X30. Y40. F3000."] == Approx(1.0 + f / 625));
    // Faster than the axes may: X 200 mm/s along X 80 Y 60 of 100 is 250 along the path.
    const double a = 500 / 0.6;
    CHECK(Timed()["G1 X800. Y600. F60000."] == Approx(1000 / 250.0 + 250 / a));
}

TEST_CASE("without accelerations time is way through rate") {
    Timed b(bench::five_axes());
    CHECK(b["G1 X100. F3000.;G0 X0"] == Approx(2.0 + 100 / 400.0));
    CHECK(b["G1 X1. F3000.;Y1."] == Approx(2 / 50.0));
}

TEST_CASE("G93: F is one through the time, ramps come on top") {
    CHECK(Timed()["G93 G1 X100. F30."] == Approx(2.0 + 50 / a_x));
    CHECK(Timed()["G93 G1 X0.1 F60000."] == Approx(2 * std::sqrt(0.1 / a_x)));
    CHECK(Timed()["G93 G1 C90. F30."] == Approx(2.0 + 45 / 400.0));
}

TEST_CASE("G0: the axis that needs longest leads, each rapid begins and ends at rest") {
    CHECK(Timed()["G0 X500."] == Approx(500 / v_x + v_x / a_x));
    CHECK(Timed()["G0 X10."] == Approx(2 * std::sqrt(10 / a_x)));
    // X 300 in 1.5 s leads the speed, Y 200 with 500 mm/s^2 the acceleration: 1 / s.
    const double rate = 1 / 1.5, ramp = 500.0 / 200.0;
    CHECK(Timed()["G0 X300. Y200."] == Approx(1 / rate + rate / ramp));
    CHECK(Timed()["G0 C180."] == Approx(2.0 + 90 / 400.0));
    CHECK(Timed()["G0 X500.;X1000."] == Approx(2 * (500 / v_x + v_x / a_x)));
}

TEST_CASE("G61 and G9 stop at the end of the block, G64 runs on") {
    const double f = 50.0, stop = f / a_x;
    CHECK(Timed()["G1 X100. F3000.;X200.;X300."] == Approx(300 / f + stop));
    CHECK(Timed()["G61 G1 X100. F3000.;X200.;X300."] == Approx(300 / f + 3 * stop));
    CHECK(Timed()["G9 G1 X100. F3000.;X200.;X300."] == Approx(300 / f + 2 * stop));
    CHECK(Timed()["G61 G1 X100. F3000.;G64 X200.;X300."] == Approx(300 / f + 2 * stop));
    CHECK(Timed()["G1 X100. F3000.;M8;X200."] == Approx(200 / f + 2 * stop));
    CHECK(Timed()["G1 X100. F3000.;G4 X0.5;X200."] == Approx(0.5 + 200 / f + 2 * stop));
    CHECK(Timed()["G1 X100. F3000.;G0 X300.;G1 X400."] ==
          Approx(200 / f + 2 * stop + 200 / v_x + v_x / a_x));
}

TEST_CASE("a corner is passed at F / R_max of parameter 1783: below, at, above") {
    const double f = 50.0;
    const auto corner = [&](double speed, double a) {
        return 100 / f + 0.5 * f / a + (f - speed) * (f - speed) / (2 * f * a);
    };
    // X then Z: both change their speed by F at once; 10 mm/s are allowed.
    CHECK(Timed()["G1 X100. F3000.;Z100."] == Approx(2 * corner(10, a_x)));
    Timed slow;  // F below the jump: the corner costs nothing
    CHECK(slow["G1 X100. F599.;Z100."] == Approx(2 * (6000 / 599.0 + 0.5 * 599 / 60 / a_x)));
    // Turning back changes X by twice F.
    CHECK(Timed()["G1 X100. F3000.;X0"] == Approx(2 * corner(5, a_x)));
    // 3 degrees: F * 2 sin(1.5 deg) = 2.6 mm/s across, within 10.
    Timed flat;
    CHECK(flat[fmt::format("G1 X100. F3000.;X{:.9f} Z{:.9f}", 100 + 100 * std::cos(pi / 60),
                           100 * std::sin(pi / 60))] ==
          Approx(200 / f + 0.5 * f / a_x + 0.5 * f * std::cos(pi / 60) / a_x));
}

TEST_CASE("an arc: v^2 / r stays within the acceleration, the axes within their speed") {
    Timed b;
    const double way = 2 * pi * 4.0;
    b.control.mover.axes.limits.per_acceleration[index_of(Axis::Y)] = 1 / a_x;
    // r 4 mm: v^2 / r = 1000 at 63.2 mm/s.
    const double v = std::sqrt(4.0 * a_x);
    CHECK(b["G2 I4. J0 F6000."] == Approx(way / v + v / a_x));
    CHECK(b["G2 I4. J0 F3000."] == Approx(way / 50 + 50 / a_x));
    CHECK(b.last().feed_mm_min == Approx(3000.0));
    b.control.mover.axes.limits.per_acceleration.fill(0.0);
    CHECK(b["G2 I40. J0 F60000."] == Approx(2 * pi * 40 / v_x));  // X at 200 mm/s
}

TEST_CASE("tangent line and arc run into each other") {
    Timed b;
    b.control.mover.axes.limits.per_acceleration[index_of(Axis::Y)] = 1 / a_x;
    const double f = 50.0;
    CHECK(b["G1 X100. F3000.;G3 X100. Y60. J30.;G1 X0"] == Approx((200 + 30 * pi) / f + f / a_x));
}

TEST_CASE("G43.4: the tip's feed, the limits of the axes that follow") {
    const std::string start = "G0 B0 C0;G43.4 H1 X100. Y0 Z0;";
    Timed b;
    b(start);
    // Rotaries at rest: as any line.
    CHECK(b["G1 X150. F3000."] == Approx(1.0 + 50 / a_x));
    // C alone, tip on the axis: C's speed and acceleration are what there is.
    Timed c;
    c("G0 B0 C0;G43.4 H1 X0 Y0 Z0");
    CHECK(c["G1 C180. F3000."] == Approx(2.0 + 90 / 400.0));
    // F in deg/min (19696#6): 30 deg/s.
    c.stores.parameters.set_bit(19696, 6, true);
    CHECK(c["G1 C90. F1800."] == Approx(3.0 + 30 / 400.0));
    // Tip 1 mm along the axis while C turns by 90: limited by C, 1 s and its ramps.
    CHECK(c["G1 Z1. C180. F3000."] == Approx(1.0 + 90 / 400.0));
    CHECK(c.last().feed_mm_min == Approx(60.0));
    // Tip 100 mm from C, which turns by 180: C needs 2 s, the ramps wait for Y's 500 mm/s^2.
    Timed far;
    far(start);
    CHECK(far["G1 C180. F60000."] == Approx(2.0 + 0.5 * pi * 100 / a_y).epsilon(1e-3));
}

TEST_CASE("rates of a curve are those of the circle it is") {
    Timed b;
    b("G0 B0 C0;G43.4 H1 X100. Y0 Z0");
    struct Look : motion::MotionSink {
        motion::MoveResult move(const motion::AxisMove& m) override {
            if (m.curve) rates = motion::path_rates(m, *limits);
            return {};
        }
        const motion::AxisLimits* limits = nullptr;
        motion::PathRates rates;
    } look;
    look.limits = &b.control.mover.axes.limits;
    controller::Control control(b.control.config, b.stores, look);
    for (const char* text : {"G90 G54 G0 B0 C0", "G43.4 H1 X100. Y0 Z0", "C180."})
        controller::execute_block(control, bench::words_of(text));
    CHECK(look.rates.start[Axis::Y] == Approx(-100 * pi).epsilon(1e-3));
    CHECK(look.rates.end[Axis::Y] == Approx(100 * pi).epsilon(1e-3));
    CHECK(std::abs(look.rates.start[Axis::X]) < 0.1);
    // X and Y turn: 100 pi^2 a unit of s squared by 500 mm/s^2 of Y.
    CHECK(look.rates.least_s ==
          Approx(std::max({2.0, pi * 100 / v_x, pi * std::sqrt(100 / a_y)})).epsilon(2e-3));
}

TEST_CASE("G31 counts the way it made, and stands before and after it") {
    Timed b;
    b.sink.trigger_at = 0.25;
    const double whole = 100 / 50.0 + 50 / a_x;
    CHECK(b["G31 X100. F3000."] == Approx(0.25 * whole));
}

}  // namespace trunnion

// G43.4 and G43.5: the tip's path, the chords of the axes and the time they take.
#include "motion/tool_centre_point.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "motion/path_rates.h"
#include "tests/support/tables.h"

namespace trunnion {

namespace {

constexpr double deg = pi / 180.0;

}  // namespace

TEST_CASE("the tip runs straight in W, the chords stay within tolerance") {
    SeededNoise noise(12);
    const positioning::RotaryTransform belief(bc_table());
    for (int k = 0; k < 50; ++k) {
        AxisPositions start;
        start[Axis::B] = noise.normal();
        start[Axis::C] = noise.normal();
        const Vector3 tool(0, 0, 150);
        const auto tcp =
            motion::ToolCentrePoint::start(belief, start, positioning::TcpFrame::start, tool);
        const Vector3 tip0 = random_vector(noise, 200);
        AxisPositions from = tcp.machine(tcp.tip_W(tip0, start), start);
        CHECK((tcp.programmed_tip_M(from) - tip0).norm() < 1e-10);
        // At the start-up pose the programmed frame is the work frame: only length compensation.
        CHECK((Vector3(from[Axis::X], from[Axis::Y], from[Axis::Z]) - tip0 - tool).norm() < 1e-10);
        AxisPositions turned = start;
        turned[Axis::B] += 1.2 * noise.normal();
        turned[Axis::C] += 2.0 * noise.normal();
        const Vector3 tip1 = random_vector(noise, 200);
        const AxisPositions to = tcp.machine(tcp.tip_W(tip1, turned), turned);
        const Vector3 a = belief.tip_W(from, tool), b = belief.tip_W(to, tool);
        CHECK((b - a).norm() == Approx((tip1 - tip0).norm()).epsilon(1e-10));
        const motion::TipLine line(tcp, from, to, a, b);
        for (double s : {0.0, 0.2, 0.5, 0.9, 1.0})
            CHECK((belief.tip_W(line.at(s), tool) - (a + s * (b - a))).norm() < 1e-10);
        const double tolerance_mm = 0.01;
        const auto steps = motion::chord_steps(line, tolerance_mm);
        double worst_mm = 0.0;
        for (std::size_t i = 1; i < steps.size(); ++i) {
            const AxisPositions q0 = line.at(steps[i - 1]), q1 = line.at(steps[i]);
            for (double part = 0.1; part < 1.0; part += 0.1) {
                AxisPositions q;
                for (std::size_t axis = 0; axis < axis_count; ++axis)
                    q.value[axis] = q0.value[axis] + part * (q1.value[axis] - q0.value[axis]);
                const double s = steps[i - 1] + part * (steps[i] - steps[i - 1]);
                worst_mm = std::max(worst_mm, (belief.tip_W(q, tool) - (a + s * (b - a))).norm());
            }
        }
        CHECK(worst_mm < 1.1 * tolerance_mm);
        CHECK(steps.size() > 4);
    }
}

TEST_CASE("chords split when their rise is above the tolerance, not at it") {
    offsets::PivotParameters pivot = bc_table();
    pivot.table_point_mm = pivot.table_offset_mm = Vector3::Zero();
    const positioning::RotaryTransform belief(pivot);
    AxisPositions from, to;
    to[Axis::C] = pi / 2;
    const Vector3 tip(80, 0, 0);
    from = belief.machine_for_tip(tip, from, Vector3::Zero());
    to = belief.machine_for_tip(tip, to, Vector3::Zero());
    const auto tcp =
        motion::ToolCentrePoint::start(belief, {}, positioning::TcpFrame::start, Vector3::Zero());
    const motion::TipLine line(tcp, from, to, tip, tip);
    // The axes run on a quarter circle of 80 mm: four chords rise by 80 (1 - cos 11.25 deg).
    const double rise_mm = 80.0 * (1.0 - std::cos(11.25 * deg));
    CHECK(motion::chord_steps(line, rise_mm * (1 + 1e-9)).size() == 5);
    CHECK(motion::chord_steps(line, rise_mm * (1 - 1e-9)).size() == 9);
    const double next_mm = 80.0 * (1.0 - std::cos(5.625 * deg));
    CHECK(motion::chord_steps(line, next_mm * (1 + 1e-9)).size() == 9);
    CHECK(motion::chord_steps(line, next_mm * (1 - 1e-9)).size() == 17);
}

TEST_CASE("WKP and the frame at rotary zero") {
    offsets::PivotParameters pivot = bc_table();
    AxisPositions start;
    start[Axis::B] = 0.4;
    const Vector3 tool(0, 0, 80);
    const positioning::RotaryTransform plain(pivot);
    const auto zero =
        motion::ToolCentrePoint::start(plain, start, positioning::TcpFrame::rotary_zero, tool);
    CHECK((zero.tip_W({1, 2, 3}, start) - Vector3(1, 2, 3)).norm() < 1e-15);
    pivot.frame_follows_work = true;
    const positioning::RotaryTransform following(pivot);
    const auto tcp =
        motion::ToolCentrePoint::start(following, start, positioning::TcpFrame::start, tool);
    AxisPositions turned = start;
    turned[Axis::C] = 1.0;
    const AxisPositions machine = tcp.machine(tcp.tip_W({1, 2, 3}, turned), turned);
    CHECK(
        (Vector3(machine[Axis::X], machine[Axis::Y], machine[Axis::Z]) - Vector3(1, 2, 83)).norm() <
        1e-12);
    CHECK((tcp.programmed_tip_M(machine) - Vector3(1, 2, 3)).norm() < 1e-12);
}

TEST_CASE("G43.5 Q leans the tool towards the travel") {
    const Vector3 n = motion::leaned(Vector3::UnitZ(), {3, 0, 4}, 10 * deg);
    CHECK((n - Vector3(std::sin(10 * deg), 0, std::cos(10 * deg))).norm() < 1e-15);
    CHECK(motion::leaned(Vector3::UnitZ(), {0, 0, 4}, 10 * deg) == Vector3::UnitZ());
}

TEST_CASE("an axis's speed bounds the time of a tip line") {
    const positioning::RotaryTransform belief(bc_table());
    motion::AxisMove move;
    move.to[Axis::C] = pi;
    move.from = belief.machine_for_tip({100, 0, 0}, move.from, Vector3::Zero());
    move.to = belief.machine_for_tip({100, 0, 0}, move.to, Vector3::Zero());
    const auto tcp =
        motion::ToolCentrePoint::start(belief, {}, positioning::TcpFrame::start, Vector3::Zero());
    const motion::TipLine line(tcp, move.from, move.to, {100, 0, 0}, {100, 0, 0});
    move.curve = &line;
    motion::AxisLimits limits{};
    limits.seconds_per_unit[index_of(Axis::C)] = 2.0 / pi;
    CHECK(motion::path_rates(move, limits).least_s == Approx(2.0));
    limits.seconds_per_unit = {};
    limits.seconds_per_unit[index_of(Axis::Y)] = 0.01;  // 100 mm/s: Y = r sin, steepest r pi
    const double radius = std::hypot(100 - 3.4, 40 - 0.2 + 0.0);
    CHECK(motion::path_rates(move, limits).least_s == Approx(0.01 * pi * radius).epsilon(2e-3));
}

}  // namespace trunnion

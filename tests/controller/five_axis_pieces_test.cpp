// Fixture offset, tilted planes, choice of solutions and the tip's path, each on its own.
#include <catch2/catch.hpp>
#include <cmath>

#include "controller/fixture_offset.h"
#include "controller/path_rates.h"
#include "controller/rotary_choice.h"
#include "controller/tilted_plane.h"
#include "controller/tool_centre_point.h"
#include "geometry/alarm.h"
#include "geometry/random.h"
#include "geometry/units.h"

namespace trunnion {

namespace {

constexpr double deg = pi / 180.0;

Vector3 random_vector(SeededNoise& noise, double size) {
    return Vector3(noise.uniform() - 0.5, noise.uniform() - 0.5, noise.uniform() - 0.5) * size;
}

PivotParameters bc_table() {
    PivotParameters pivot;
    pivot.unit = MechanicalUnit::table_table;
    pivot.first.line = Vector3::UnitY();
    pivot.second.axis = Axis::C;
    pivot.first.sign = pivot.second.sign = -1.0;
    pivot.table_point_mm = {3, -40, 120};
    pivot.table_offset_mm = {0.4, 0.2, -55};
    return pivot;
}

PlaneWords angles(double i, double j, double k) {
    PlaneWords w;
    w.i = i;
    w.j = j;
    w.k = k;
    return w;
}

PlaneWords block(double p, double q) {
    PlaneWords w;
    w.p = p;
    w.q = q;
    return w;
}

PlaneWords point(double q, double x, double y, double z) {
    PlaneWords w = block(2, q);
    w.x = x;
    w.y = y;
    w.z = z;
    return w;
}

Pose complete(const PlaneWords& w) {
    return *PlaneDefinition().add(w);
}

template <class Action>
int alarm_of(Action action) {
    try {
        action();
    } catch (const Alarm& alarm) {
        return alarm.number;
    }
    return 0;
}

const std::vector<Axis> bc_order{Axis::X, Axis::Y, Axis::Z, Axis::B, Axis::C};

}  // namespace

TEST_CASE("G54.2 vector is R(theta) R(theta0)^-1 f0 of the table") {
    SeededNoise noise(6);
    const RotaryTransform belief(bc_table());
    Parameters p;
    const FixtureSettings settings = decode_fixture_settings(p, bc_order);
    CHECK(settings.assumed);
    for (int k = 0; k < 500; ++k) {
        FixtureOffset fixture;
        const Vector3 f0 = random_vector(noise, 300);
        fixture.offset[Axis::X] = f0.x();
        fixture.offset[Axis::Y] = f0.y();
        fixture.offset[Axis::Z] = f0.z();
        OffsetVector now;
        AxisPositions q, q0;
        for (const Axis axis : {Axis::B, Axis::C}) {
            fixture.reference_angles[axis] = 400 * (noise.uniform() - 0.5);
            now[axis] = 2000 * (noise.uniform() - 0.5);
            q[axis] = now[axis] * deg;
            q0[axis] = fixture.reference_angles[axis] * deg;
        }
        const Vector3 expected =
            belief.pose_MW(q).rotation * belief.pose_MW(q0).rotation.transpose() * f0;
        const OffsetVector f = turned_fixture_offset(settings, fixture, now);
        CHECK((Vector3(f[Axis::X], f[Axis::Y], f[Axis::Z]) - expected).norm() < 1e-10);
        CHECK(f[Axis::B] == 0.0);
    }
}

TEST_CASE("G54.2 groups and FAX as typed") {
    Parameters p;
    p.set(7580, 5);  // C carries +X to +Y: a right-handed table
    p.set(7581, 1);
    p.set(7582, 2);
    p.entry[7575].by_axis = {{1, 1.0}, {2, 0.0}};
    const FixtureSettings settings = decode_fixture_settings(p, bc_order);
    CHECK_FALSE(settings.assumed);
    FixtureOffset fixture;
    fixture.offset[Axis::X] = 10;
    fixture.offset[Axis::Z] = 7;
    OffsetVector now;
    now[Axis::C] = 60;
    now[Axis::B] = 45;  // no group: does not turn the offset
    const OffsetVector f = turned_fixture_offset(settings, fixture, now);
    CHECK(f[Axis::X] == Approx(5));
    CHECK(f[Axis::Y] == 0.0);  // 7575#0 of Y is off
    CHECK(f[Axis::Z] == 0.0);
    p.set(7581, 4);
    CHECK(alarm_of([&] { decode_fixture_settings(p, bc_order); }) == 5459);
    p.set(7581, 2);
    CHECK(alarm_of([&] { decode_fixture_settings(p, bc_order); }) == 5459);
}

TEST_CASE("G68.2 P0 Euler angles about moved axes") {
    const Pose frame = complete(angles(30, 50, 70));
    const Matrix3 expected = rotation_about(Vector3::UnitZ(), 30 * deg) *
                             rotation_about(Vector3::UnitX(), 50 * deg) *
                             rotation_about(Vector3::UnitZ(), 70 * deg);
    CHECK((frame.rotation - expected).norm() < 1e-15);
    PlaneWords w = angles(30, 50, 70);
    w.q = 232;
    CHECK((complete(w).rotation - rotation_about(Vector3::UnitY(), 30 * deg) *
                                      rotation_about(Vector3::UnitZ(), 50 * deg) *
                                      rotation_about(Vector3::UnitY(), 70 * deg))
              .norm() < 1e-15);
    w = angles(0, 90, 0);
    w.x = 5;
    w.z = -2;
    w.r = 90;
    const Pose shifted = complete(w);
    CHECK(shifted.translation_mm == Vector3(5, 0, -2));
    CHECK((shifted.rotation.col(0) - Vector3::UnitZ()).norm() < 1e-15);
}

TEST_CASE("G68.2 P1 roll, pitch, yaw about the work frame's axes") {
    const Matrix3 x = rotation_about(Vector3::UnitX(), 10 * deg);
    const Matrix3 y = rotation_about(Vector3::UnitY(), 20 * deg);
    const Matrix3 z = rotation_about(Vector3::UnitZ(), 30 * deg);
    PlaneWords w = angles(10, 20, 30);
    w.p = 1;
    CHECK((complete(w).rotation - z * y * x).norm() < 1e-15);
    w.q = 312;  // about Z first, then X, then Y; I stays the angle about X
    CHECK((complete(w).rotation - y * x * z).norm() < 1e-15);
    w.q = 313;
    CHECK(alarm_of([&] { complete(w); }) == 5457);
}

TEST_CASE("G68.2 P2 three points and P3 two vectors") {
    PlaneDefinition plane;
    PlaneWords shift = block(2, 0);
    shift.x = 1;
    shift.y = 2;
    shift.z = 3;
    shift.r = 90;
    CHECK_FALSE(plane.add(shift));
    CHECK(plane.pending());
    CHECK_FALSE(plane.add(point(1, 10, 0, 0)));
    CHECK_FALSE(plane.add(point(3, 10, 0, 7)));
    const auto frame = plane.add(point(2, 10, 5, 0));  // x = +Y, y = +Z, z = +X of the work
    REQUIRE(frame);
    CHECK_FALSE(plane.pending());
    CHECK((frame->translation_mm - Vector3(13, 1, 2)).norm() < 1e-14);
    CHECK((frame->rotation.col(0) - Vector3::UnitZ()).norm() < 1e-15);
    CHECK((frame->rotation.col(2) - Vector3::UnitX()).norm() < 1e-15);

    const auto vector = [](double q, double i, double j, double k) {
        PlaneWords w = angles(i, j, k);
        w.p = 3;
        w.q = q;
        return w;
    };
    PlaneWords origin = vector(1, 0, 2, 0);
    origin.x = 4;
    REQUIRE_FALSE(plane.add(origin));
    const auto made = plane.add(vector(2, 1, 0.05, 0));  // 2.9 deg off square: made square
    REQUIRE(made);
    CHECK(made->translation_mm == Vector3(4, 0, 0));
    CHECK((made->rotation.col(0) - Vector3::UnitY()).norm() < 1e-15);
    CHECK((made->rotation.col(2) - Vector3::UnitX()).norm() < 1e-15);
    CHECK(alarm_of([&] {
              PlaneDefinition crooked;
              crooked.add(origin);
              crooked.add(vector(2, 1, 0.09, 0));
          }) == 5457);
}

TEST_CASE("G68.2 P4 projection angles") {
    PlaneWords w = angles(30, 20, 0);
    w.p = 4;
    const Pose frame = complete(w);
    const Vector3 x = frame.rotation.col(0), z = frame.rotation.col(2);
    CHECK((x - Vector3(std::cos(30 * deg), 0, -std::sin(30 * deg))).norm() < 1e-15);
    CHECK(z.dot(Vector3(0, std::cos(20 * deg), std::sin(20 * deg))) == Approx(0).margin(1e-15));
    CHECK(frame.rotation.determinant() == Approx(1.0));
    CHECK((frame.rotation * frame.rotation.transpose()).isIdentity(1e-14));
}

TEST_CASE("G68.2 format errors are alarm 5457") {
    const auto alarm = [](const PlaneWords& w) {
        return alarm_of([&] { PlaneDefinition().add(w); });
    };
    CHECK(alarm(PlaneWords{}) == 5457);  // no angle at all
    CHECK(alarm(block(5, 1)) == 5457);
    CHECK(alarm(block(2.5, 1)) == 5457);
    PlaneWords w = block(2, 1);
    CHECK(alarm(w) == 5457);  // a point without X Y Z
    w.q.reset();
    CHECK(alarm(w) == 5457);
    CHECK(alarm(block(2, 4)) == 5457);
    CHECK(alarm(block(3, 1)) == 5457);  // no vector
    const auto points = [](Vector3 second, Vector3 third) {
        return alarm_of([&] {
            PlaneDefinition plane;
            plane.add(point(1, 1, 1, 1));
            plane.add(point(2, second.x(), second.y(), second.z()));
            plane.add(point(3, third.x(), third.y(), third.z()));
        });
    };
    CHECK(points({2, 2, 2}, {3, 3, 3}) == 5457);
    CHECK(points({1, 1, 1}, {3, 3, 4}) == 5457);
    CHECK(points({2, 2, 2}, {3, 3, 4}) == 0);
    CHECK(alarm_of([] {
              PlaneDefinition plane;
              plane.add(point(1, 0, 0, 0));
              plane.add(point(1, 0, 0, 0));
          }) == 5457);
    CHECK(alarm_of([] {
              PlaneDefinition plane;
              plane.add(point(1, 0, 0, 0));
              plane.add(angles(0, 0, 0));
          }) == 5457);
}

TEST_CASE("G68.3: Z along the tool, X square to the vertical") {
    const Vector3 tool = Vector3(1, 2, 3).normalized();
    const Pose frame = plane_of_tool(tool, {7, 8, 9}, 0, {});
    CHECK((frame.rotation.col(2) - tool).norm() < 1e-15);
    CHECK((frame.rotation.col(0) - Vector3::UnitZ().cross(tool).normalized()).norm() < 1e-15);
    CHECK(frame.translation_mm == Vector3(7, 8, 9));
    CHECK(frame.rotation.determinant() == Approx(1.0));
    CHECK(plane_of_tool(Vector3::UnitZ(), {}, 0, {}).rotation.isIdentity(1e-15));
    const Matrix3 turned = plane_of_tool(Vector3::UnitZ(), {}, 30, {}).rotation;
    CHECK((turned - rotation_about(Vector3::UnitZ(), 30 * deg)).norm() < 1e-15);
}

TEST_CASE("G53.1 takes the least move of the master, then of the slave, then nearest 0") {
    const RotaryTransform belief(bc_table());
    AxisPositions q;
    q[Axis::B] = 30 * deg;
    q[Axis::C] = 50 * deg;
    const Vector3 n = belief.tool_direction_W(q);
    const auto chosen = [&](RotarySolution present, RotaryTravel travel = {},
                            Branch branch = Branch::nearest) {
        const auto choice = choose_rotaries(belief, n, present, travel, branch);
        return choice.chosen.value_or(RotarySolution{99, 99});
    };
    const auto is = [](const RotarySolution& s, double b, double c) {
        return std::abs(s.first_rad - b * deg) < 1e-12 && std::abs(s.second_rad - c * deg) < 1e-11;
    };
    CHECK(is(chosen({0, 0}), 30, 50));                 // equal B, less C
    CHECK(is(chosen({0, -100 * deg}), -30, -130));     // equal B, less C
    CHECK(is(chosen({1 * deg, -100 * deg}), 30, 50));  // less B wins over less C
    CHECK(is(chosen({0, 0}, {}, Branch::negative), -30, -130));
    CHECK(is(chosen({-20 * deg, 0}, {}, Branch::positive), 30, 50));
    CHECK(is(chosen({0, 5000 * deg}), 30, 5090));  // nearest turn of C
    RotaryTravel narrow;
    narrow.first = {-5 * deg, 110 * deg};
    CHECK(is(chosen({-4 * deg, -130 * deg}, narrow), 30, 50));
    narrow.second = {60 * deg, 400 * deg};
    CHECK(is(chosen({0, 70 * deg}, narrow), 30, 410) == false);
    narrow.second = {60 * deg, 420 * deg};
    CHECK(is(chosen({0, 70 * deg}, narrow), 30, 410));  // rewound inside the travel
    narrow.first = {0.0, 20 * deg};
    CHECK(is(chosen({0, 0}, narrow), 99 / deg, 99 / deg));
    CHECK(choose_rotaries(belief, n, {0, 0}, {}).all.size() == 2);
}

TEST_CASE("a rotary that already stands right is not stirred, at any number of turns") {
    const RotaryTransform belief(bc_table());
    RotarySolution stands{-33.3 * deg, -145318.181 * deg};
    const auto n = belief.tool_direction_W(belief.with_rotaries({}, stands));
    const auto choice = choose_rotaries(belief, n, stands, {});
    REQUIRE(choice.chosen);
    CHECK(choice.chosen->first_rad == Approx(stands.first_rad).margin(1e-12));
    CHECK(std::abs(deg_from_rad(choice.chosen->second_rad) + 145318.181) < 1e-9);
}

TEST_CASE("the tip runs straight in W, the chords stay within tolerance") {
    SeededNoise noise(12);
    const RotaryTransform belief(bc_table());
    for (int k = 0; k < 50; ++k) {
        AxisPositions start;
        start[Axis::B] = noise.normal();
        start[Axis::C] = noise.normal();
        const Vector3 tool(0, 0, 150);
        const auto tcp = ToolCentrePoint::start(belief, start, TcpFrame::start, tool);
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
        const TipLine line(tcp, from, to, a, b);
        for (double s : {0.0, 0.2, 0.5, 0.9, 1.0})
            CHECK((belief.tip_W(line.at(s), tool) - (a + s * (b - a))).norm() < 1e-10);
        const double tolerance_mm = 0.01;
        const auto steps = chord_steps(line, tolerance_mm);
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
    PivotParameters pivot = bc_table();
    pivot.table_point_mm = pivot.table_offset_mm = Vector3::Zero();
    const RotaryTransform belief(pivot);
    AxisPositions from, to;
    to[Axis::C] = pi / 2;
    const Vector3 tip(80, 0, 0);
    from = belief.machine_for_tip(tip, from, Vector3::Zero());
    to = belief.machine_for_tip(tip, to, Vector3::Zero());
    const auto tcp = ToolCentrePoint::start(belief, {}, TcpFrame::start, Vector3::Zero());
    const TipLine line(tcp, from, to, tip, tip);
    // The axes run on a quarter circle of 80 mm: four chords rise by 80 (1 - cos 11.25 deg).
    const double rise_mm = 80.0 * (1.0 - std::cos(11.25 * deg));
    CHECK(chord_steps(line, rise_mm * (1 + 1e-9)).size() == 5);
    CHECK(chord_steps(line, rise_mm * (1 - 1e-9)).size() == 9);
    const double next_mm = 80.0 * (1.0 - std::cos(5.625 * deg));
    CHECK(chord_steps(line, next_mm * (1 + 1e-9)).size() == 9);
    CHECK(chord_steps(line, next_mm * (1 - 1e-9)).size() == 17);
}

TEST_CASE("WKP and the frame at rotary zero") {
    PivotParameters pivot = bc_table();
    AxisPositions start;
    start[Axis::B] = 0.4;
    const Vector3 tool(0, 0, 80);
    const RotaryTransform plain(pivot);
    const auto zero = ToolCentrePoint::start(plain, start, TcpFrame::rotary_zero, tool);
    CHECK((zero.tip_W({1, 2, 3}, start) - Vector3(1, 2, 3)).norm() < 1e-15);
    pivot.frame_follows_work = true;
    const RotaryTransform following(pivot);
    const auto tcp = ToolCentrePoint::start(following, start, TcpFrame::start, tool);
    AxisPositions turned = start;
    turned[Axis::C] = 1.0;
    const AxisPositions machine = tcp.machine(tcp.tip_W({1, 2, 3}, turned), turned);
    CHECK(
        (Vector3(machine[Axis::X], machine[Axis::Y], machine[Axis::Z]) - Vector3(1, 2, 83)).norm() <
        1e-12);
    CHECK((tcp.programmed_tip_M(machine) - Vector3(1, 2, 3)).norm() < 1e-12);
}

TEST_CASE("G43.5 Q leans the tool towards the travel") {
    const Vector3 n = leaned(Vector3::UnitZ(), {3, 0, 4}, 10 * deg);
    CHECK((n - Vector3(std::sin(10 * deg), 0, std::cos(10 * deg))).norm() < 1e-15);
    CHECK(leaned(Vector3::UnitZ(), {0, 0, 4}, 10 * deg) == Vector3::UnitZ());
}

TEST_CASE("an axis's speed bounds the time of a tip line") {
    const RotaryTransform belief(bc_table());
    AxisMove move;
    move.to[Axis::C] = pi;
    move.from = belief.machine_for_tip({100, 0, 0}, move.from, Vector3::Zero());
    move.to = belief.machine_for_tip({100, 0, 0}, move.to, Vector3::Zero());
    const auto tcp = ToolCentrePoint::start(belief, {}, TcpFrame::start, Vector3::Zero());
    const TipLine line(tcp, move.from, move.to, {100, 0, 0}, {100, 0, 0});
    move.curve = &line;
    AxisLimits limits{};
    limits.seconds_per_unit[index_of(Axis::C)] = 2.0 / pi;
    CHECK(path_rates(move, limits).least_s == Approx(2.0));
    limits.seconds_per_unit = {};
    limits.seconds_per_unit[index_of(Axis::Y)] = 0.01;  // 100 mm/s: Y = r sin, steepest r pi
    const double radius = std::hypot(100 - 3.4, 40 - 0.2 + 0.0);
    CHECK(path_rates(move, limits).least_s == Approx(0.01 * pi * radius).epsilon(2e-3));
}

}  // namespace trunnion

#include "kinematics/machine.h"

#include <catch2/catch.hpp>

#include "base/alarm.h"
#include "base/random.h"
#include "base/units.h"
#include "kinematics/forward.h"

using namespace trunnion;

namespace {

constexpr double tiny = 1e-12;

double apart(const Vector3& a, const Vector3& b) {
    return (a - b).norm();
}

kinematics::Machine bc_table() {
    kinematics::Machine machine;
    machine.chain = kinematics::parse_chain("w C B b X Y Z t");
    machine.chain.work[0].direction = {0, -1, 0};
    machine.chain.work[0].point_mm = {10, -3, 40};
    machine.chain.work[1].direction = {0, 0, -1};
    machine.chain.work[1].point_mm = {12, 5, 60};
    return machine;
}

AxisPositions at(double x, double y, double z, double b, double c) {
    AxisPositions q;
    q[Axis::X] = x, q[Axis::Y] = y, q[Axis::Z] = z;
    q[Axis::B] = b, q[Axis::C] = c;
    return q;
}

Matrix3 ry(double t) {
    return rotation_about(Vector3::UnitY(), t);
}
Matrix3 rz(double t) {
    return rotation_about(Vector3::UnitZ(), t);
}

AxisPositions random_positions(SeededNoise& noise) {
    AxisPositions q;
    for (const Axis axis : all_axes)
        q[axis] = is_rotary(axis) ? pi * noise.normal() : 200.0 * noise.normal();
    return q;
}

void set_all_errors(kinematics::Machine& machine, SeededNoise& noise) {
    for (const kinematics::AxisGeometry& axis : machine.chain.axes()) {
        kinematics::AxisErrors& errors = machine.errors.axis[index_of(axis.axis)];
        for (std::size_t k = 0; k < 6; ++k) {
            const double size = k < 3 ? 0.01 : 5e-5;
            errors.location[k] = size * noise.normal();
            kinematics::ErrorCurve& curve = errors.motion[k];
            curve.constant = size * noise.normal();
            curve.slope = size * noise.normal() / (axis.rotary ? 1.0 : 100.0);
            curve.period_mm = axis.rotary ? 0.0 : 40.0;
            curve.harmonics = {{1.0, size * noise.normal(), 0.0},
                               {2.0, 0.0, size * noise.normal()}};
            curve.at = {-300, -100, 0, 120, 300};
            curve.value = {0.0, size, -size, 0.5 * size, 0.0};
            curve.interpolation = k % 2 ? kinematics::ErrorCurve::Interpolation::cubic
                                        : kinematics::ErrorCurve::Interpolation::linear;
        }
    }
}

}  // namespace

TEST_CASE("a chain finds each of its axes by its identity, and no other") {
    const kinematics::Machine machine = bc_table();
    for (const Axis axis : {Axis::X, Axis::Y, Axis::Z, Axis::B, Axis::C}) {
        REQUIRE(machine.chain.find(axis));
        CHECK(machine.chain.find(axis)->axis == axis);
    }
    CHECK_FALSE(machine.chain.find(Axis::A));
}

TEST_CASE("chain text is read from the bed outwards") {
    const kinematics::Chain chain = kinematics::parse_chain("w C B b X Y Z t");
    REQUIRE(chain.work.size() == 2);
    CHECK(chain.work[0].axis == Axis::B);
    CHECK(chain.work[1].axis == Axis::C);
    CHECK(chain.tool[2].axis == Axis::Z);
    CHECK(chain.work[1].direction == Vector3(0, 0, -1));
    CHECK(kinematics::parse_chain("w b X t").work.empty());
    for (const char* bad : {"", "w t", "w X Y t", "w b X X t", "w 1Q b X t", "b X t", "w X-Y b t"})
        CHECK_THROWS_AS(kinematics::parse_chain(bad), InputError);
}

TEST_CASE("error names go both ways") {
    for (const char* text : {"EXX", "EC0A", "EX0C", "EBZ", "EC0Y"})
        CHECK(to_string(kinematics::parse_error_name(text).value()) == text);
    for (const char* bad : {"EX", "FXX", "EX1C", "EDX", "EXD", "EXXX", "exx"})
        CHECK_FALSE(kinematics::parse_error_name(bad));
}

TEST_CASE("error-free table-table machine obeys the independent closed form") {
    // P - r = Rz(kC) [ Ry(kB) (J - r - D) + D ], D from a point of C to a point of B (issue 4)
    const kinematics::Machine machine = bc_table();
    SeededNoise noise(1);
    const Vector3 r(12, 5, 60), d = Vector3(10, -3, 40) - r, tip(1, 2, -150);
    for (int i = 0; i < 200; ++i) {
        const AxisPositions q = random_positions(noise);
        const Vector3 j = Vector3(q[Axis::X], q[Axis::Y], q[Axis::Z]) + tip;
        const Vector3 expected = r + rz(q[Axis::C]) * (ry(q[Axis::B]) * (j - r - d) + d);
        CHECK(apart(machine.tip_W(q, tip), expected) < 1e-10);
    }
}

TEST_CASE("head-table, head-head and inclined axes turn about their own points") {
    kinematics::Machine machine;
    machine.chain = kinematics::parse_chain("w C b X Y Z B t");
    machine.chain.work[0].point_mm = {3, 4, 0};
    machine.chain.tool[3].point_mm = {0, 0, 50};
    const Vector3 tip(0, 0, -100);
    const double b = 0.3, c = 0.7;
    const Vector3 tip_M =
        Vector3(10, 20, 30) + Vector3(0, 0, 50) + ry(b) * (tip - Vector3(0, 0, 50));
    const Vector3 point(3, 4, 0);
    CHECK(apart(machine.tip_W(at(10, 20, 30, b, c), tip), point + rz(c) * (tip_M - point)) <
          tiny * 1e3);

    machine.chain = kinematics::parse_chain("w b X Y Z C B t");
    machine.chain.tool[4].direction = Vector3(0, 1, 1).normalized();
    machine.chain.tool[4].point_mm = {0, 0, -20};
    const Vector3 p(0, 0, -20);
    const Matrix3 nutate = rotation_about(Vector3(0, 1, 1).normalized(), b);
    const Vector3 expected = Vector3(1, 2, 3) + rz(c) * (p + nutate * (tip - p));
    CHECK(apart(machine.tip_W(at(1, 2, 3, b, c), tip), expected) < tiny * 1e3);
    // 180 degrees about an axis at 45 degrees turns the spindle from vertical to horizontal
    const kinematics::MachinePose poses = machine.poses(at(0, 0, 0, pi, 0));
    CHECK(apart(poses.pose_MS.rotation * Vector3::UnitZ(), Vector3::UnitY()) < tiny);
}

TEST_CASE("axes on the work side and extra axes move the right body") {
    kinematics::Machine machine;
    machine.chain = kinematics::parse_chain("w X b Y Z W t");
    AxisPositions q = at(10, 20, 30, 0, 0);
    q[Axis::W] = -5;
    CHECK(apart(machine.tip_W(q, Vector3(0, 0, -100)), Vector3(10, 20, -75)) < tiny);
    CHECK(apart(machine.poses(q).pose_MW.translation_mm, Vector3(-10, 0, 0)) < tiny);
}

TEST_CASE("location errors follow the formula of the contract") {
    // x' = q + delta + exp([eps]x) Rot(u, word) (x - q), C carried by B
    kinematics::Machine machine = bc_table();
    const Vector3 qb(10, -3, 40), qc(12, 5, 60), w(50, -40, 80);
    auto& eb = machine.errors.axis[index_of(Axis::B)].location;
    auto& ec = machine.errors.axis[index_of(Axis::C)].location;
    eb = {0.01, -0.02, 0.03, 2e-5, -3e-5, 5e-5};
    ec = {-0.04, 0.005, 0.01, -6e-5, 4e-5, 1e-5};
    const double b = 0.8, c = -2.1;
    const Vector3 in_b =
        qc + Vector3(-0.04, 0.005, 0.01) + rotation_of({-6e-5, 4e-5, 1e-5}) * rz(-c) * (w - qc);
    const Vector3 in_m =
        qb + Vector3(0.01, -0.02, 0.03) + rotation_of({2e-5, -3e-5, 5e-5}) * ry(-b) * (in_b - qb);
    CHECK(apart(machine.poses(at(0, 0, 0, b, c)).pose_MW * w, in_m) < tiny * 100);
}

TEST_CASE("error motions of a carried rotary axis are along its carrier's axes") {
    kinematics::Machine machine = bc_table();
    machine.errors.motion({'X', false, Axis::C}).constant = 0.01;
    machine.errors.motion({'A', false, Axis::C}).constant = 1e-4;
    const double b = 0.8, c = -2.1;
    const Vector3 qb(10, -3, 40), qc(12, 5, 60), w(50, -40, 80);
    const Vector3 in_b = qc + Vector3(0.01, 0, 0) + rotation_of({1e-4, 0, 0}) * rz(-c) * (w - qc);
    CHECK(apart(machine.poses(at(0, 0, 0, b, c)).pose_MW * w, qb + ry(-b) * (in_b - qb)) < 1e-10);
}

TEST_CASE("linear axes: squareness leans the path, angular errors turn all that the axis carries") {
    kinematics::Machine machine;
    machine.chain = kinematics::parse_chain("w b X Y Z t");
    machine.errors.location({'C', true, Axis::Y}) = 1e-4;  // Y leans towards -X
    const Vector3 tip(0, 0, -150);
    Vector3 error = machine.tip_W(at(10, 200, 30, 0, 0), tip) - Vector3(10, 200, -120);
    CHECK(apart(error, Vector3(-0.02, 0, 0)) < 2e-6);
    machine.errors.location({'C', true, Axis::Y}) = 0.0;

    machine.errors.motion({'B', false, Axis::X}).slope = 1e-6;  // pitch
    machine.errors.motion({'X', false, Axis::X}).slope = 1e-5;
    error = machine.tip_W(at(100, 200, 30, 0, 0), tip) - Vector3(100, 200, -120);
    CHECK(apart(error, Vector3(1e-3 - 1e-4 * 120, 0, 0)) < 2e-6);  // X carries Z and the tool
}

TEST_CASE("the prepared model is the machine, with and without perturbation") {
    SeededNoise noise(5);
    for (const char* text :
         {"w C B b X Y Z t", "w C b X Y Z B t", "w X A b Y Z W C t", "w Y X b Z t"}) {
        kinematics::Machine machine;
        machine.chain = kinematics::parse_chain(text);
        for (int errors = 0; errors < 2; ++errors) {
            if (errors) set_all_errors(machine, noise);
            machine.errors.spindle.location[3] = errors ? 1e-5 : 0.0;
            const kinematics::ForwardModel model(machine);
            for (int i = 0; i < 20; ++i) {
                const AxisPositions q = random_positions(noise);
                kinematics::Perturbation extra;
                extra.axis[Axis::X] = 0.01;
                extra.motion[index_of(Axis::Y)].tilt_rad.x() = 1e-4;
                const kinematics::MachinePose a = machine.poses(q, extra),
                                              b = model.poses(q, extra);
                CHECK(a.pose_MW.rotation == b.pose_MW.rotation);
                CHECK(a.pose_MS.translation_mm == b.pose_MS.translation_mm);
                CHECK(machine.tip_W(q, Vector3(1, 2, 3)) == model.tip_W(q, Vector3(1, 2, 3)));
                const Matrix3 r = a.pose_MS.rotation * a.pose_MW.rotation;
                CHECK((r * r.transpose() - Matrix3::Identity()).norm() < 1e-14);
            }
        }
    }
}

TEST_CASE("a ripple comes back after its period, on a rotary axis after a turn") {
    kinematics::ErrorCurve curve;
    curve.harmonics = {{1.0, 0.003, 0.004}, {3.0, 0.0, 0.001}};
    for (const double period_mm : {10.0, 0.0}) {
        curve.period_mm = period_mm;
        const double period = period_mm > 0.0 ? period_mm : 2.0 * pi;
        CHECK(curve(0.0) == Approx(0.003));
        CHECK(curve(0.5 * period) == Approx(-0.003));
        CHECK(curve(0.25 * period) == Approx(0.003));  // 0.004 of the first, -0.001 of the third
        CHECK(curve(7.3 * period) == Approx(curve(0.3 * period)));
    }
}

TEST_CASE("error curves: tables hit their points, stay flat beyond, and derivatives are true") {
    kinematics::ErrorCurve curve;
    curve.constant = 0.001;
    curve.slope = 1e-5;
    curve.period_mm = 10.0;
    curve.harmonics = {{2.0, 0.003, -0.002}};
    curve.at = {-300, -50, 0, 300};
    curve.value = {0.003, 0.001, 0.0, -0.002};
    for (const auto kind : {kinematics::ErrorCurve::Interpolation::linear,
                            kinematics::ErrorCurve::Interpolation::cubic}) {
        curve.interpolation = kind;
        for (const double q : {-400.0, -299.0, -51.0, -49.0, 10.0, 123.4, 299.0, 350.0}) {
            const double h = 1e-4;
            const double numeric = (curve(q + h) - curve(q - h)) / (2 * h);
            CHECK(curve.derivative(q) == Approx(numeric).margin(1e-9));
        }
        kinematics::ErrorCurve bare;
        bare.at = curve.at;
        bare.value = curve.value;
        bare.interpolation = kind;
        for (std::size_t i = 0; i < bare.at.size(); ++i)
            CHECK(bare(bare.at[i]) == Approx(bare.value[i]).margin(1e-18));
        CHECK(bare(1e4) == -0.002);
        CHECK(bare(-1e4) == 0.003);
    }
    curve.interpolation = kinematics::ErrorCurve::Interpolation::cubic;
    curve.at = {0, 1, 3, 4};
    curve.value = {0, 1, 9, 16};  // a parabola: three-point slopes follow it between inner points
    curve.constant = curve.slope = 0.0;
    curve.harmonics.clear();
    CHECK(curve(2.2) == Approx(4.84));
}

TEST_CASE("error curves: without interpolation a table holds at its positions alone") {
    kinematics::ErrorCurve curve;
    curve.at = {0, 10, 30};
    curve.value = {0.001, 0.002, 0.003};
    curve.interpolation = kinematics::ErrorCurve::Interpolation::none;
    const auto meets = [&](double q, double value) {
        INFO(q);
        CHECK(curve(q) == value);
        CHECK(curve.derivative(q) == 0.0);
    };
    meets(0.0, 0.001);
    meets(10.0, 0.002);
    meets(30.0, 0.003);
    // A hundredth of the distance to the nearest other position: 0.1, 0.1, 0.2.
    for (const double side : {-1.0, 1.0}) {
        meets(0.0 + side * 0.0999, 0.001);
        meets(0.0 + side * 0.1001, 0.0);
        meets(10.0 + side * 0.0999, 0.002);
        meets(10.0 + side * 0.1001, 0.0);
        meets(30.0 + side * 0.1999, 0.003);
        meets(30.0 + side * 0.2001, 0.0);
    }
    for (const double q : {-1e6, 5.0, 20.0, 1e6}) meets(q, 0.0);
    CHECK(kinematics::parse_interpolation("none") == kinematics::ErrorCurve::Interpolation::none);
    CHECK_FALSE(kinematics::parse_interpolation("None"));
}

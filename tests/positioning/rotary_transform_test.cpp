// The believed transform against formulas that share no code with it.
#include "positioning/rotary_transform.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "base/random.h"
#include "base/units.h"

namespace trunnion {

namespace {

Vector3 random_vector(SeededNoise& noise, double size) {
    return Vector3(noise.uniform() - 0.5, noise.uniform() - 0.5, noise.uniform() - 0.5) * size;
}

offsets::PivotParameters table(Axis tilt, double sign) {
    offsets::PivotParameters pivot;
    pivot.unit = offsets::MechanicalUnit::table_table;
    pivot.first.axis = tilt;
    pivot.first.line = tilt == Axis::A ? Vector3::UnitX() : Vector3::UnitY();
    pivot.second.axis = Axis::C;
    pivot.first.sign = pivot.second.sign = sign;
    return pivot;
}

offsets::PivotParameters head(Axis tilt) {
    offsets::PivotParameters pivot = table(tilt, 1.0);
    pivot.unit = offsets::MechanicalUnit::tool_tool;
    std::swap(pivot.first, pivot.second);
    return pivot;
}

Matrix3 rz(double t) {
    Matrix3 m;
    m << std::cos(t), -std::sin(t), 0, std::sin(t), std::cos(t), 0, 0, 0, 1;
    return m;
}
Matrix3 rx(double t) {
    Matrix3 m;
    m << 1, 0, 0, 0, std::cos(t), -std::sin(t), 0, std::sin(t), std::cos(t);
    return m;
}
Matrix3 ry(double t) {
    Matrix3 m;
    m << std::cos(t), 0, std::sin(t), 0, 1, 0, -std::sin(t), 0, std::cos(t);
    return m;
}

double angle_between(const Vector3& a, const Vector3& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

TEST_CASE("table-table tip against P - r = Rz(kC)[R(kT)(J - r - D) + D]") {
    SeededNoise noise(1);
    double worst_mm = 0.0;
    for (int i = 0; i < 2000; ++i) {
        const Axis tilt = i % 2 == 0 ? Axis::A : Axis::B;
        const double sign = i % 4 < 2 ? 1.0 : -1.0;
        offsets::PivotParameters pivot = table(tilt, sign);
        const Vector3 r = random_vector(noise, 300), offset = random_vector(noise, 200);
        pivot.table_point_mm = r + offset;
        pivot.table_offset_mm = -offset;
        const positioning::RotaryTransform belief(pivot);
        const double length_mm = 200 * noise.uniform();
        const Vector3 along_z(0, 0, length_mm);
        const Vector3 J = random_vector(noise, 500);
        AxisPositions q;
        q[Axis::X] = J.x();
        q[Axis::Y] = J.y();
        q[Axis::Z] = J.z();
        q[tilt] = 6 * (noise.uniform() - 0.5);
        q[Axis::C] = 20 * (noise.uniform() - 0.5);
        const double k = -sign;
        const Vector3 D = offset + along_z;
        const Matrix3 R = tilt == Axis::A ? rx(k * q[tilt]) : ry(k * q[tilt]);
        const Vector3 P = r + rz(k * q[Axis::C]) * (R * (J - r - D) + D);
        worst_mm = std::max(worst_mm, (belief.tip_W(q, along_z) + along_z - P).norm());
    }
    CHECK(worst_mm < 1e-9);
}

TEST_CASE("closed orientation inverse of BC and AC tables, both branches") {
    SeededNoise noise(2);
    for (int i = 0; i < 500; ++i) {
        const Vector3 n = random_vector(noise, 2).normalized();
        const positioning::RotaryTransform bc(table(Axis::B, 1.0)), ac(table(Axis::A, 1.0));
        const double tilt = std::acos(n.z());
        const auto check = [&](const positioning::RotaryTransform& belief, double c_plus,
                               double c_minus) {
            const auto found = belief.orient(n, {});
            REQUIRE(found.size() == 2);
            for (const positioning::RotarySolution& s : found) {
                CHECK(std::abs(s.first_rad) == Approx(tilt).margin(1e-9));
                const double c = s.first_rad > 0 ? c_plus : c_minus;
                CHECK(std::abs(std::remainder(s.second_rad - c, 2 * pi)) < 1e-9);
            }
        };
        check(bc, std::atan2(n.y(), -n.x()), std::atan2(-n.y(), n.x()));
        check(ac, std::atan2(n.x(), n.y()), std::atan2(-n.x(), -n.y()));
    }
}

TEST_CASE("head-head tip: the second axis stands at P - D, P of the first, D of 19712-19714") {
    SeededNoise noise(2);
    for (const Axis tilt : {Axis::A, Axis::B})
        for (int i = 0; i < 100; ++i) {
            offsets::PivotParameters pivot = head(tilt);
            pivot.tool_offset_mm = random_vector(noise, 200);
            pivot.tool_second_offset_mm = random_vector(noise, 200);
            pivot.holder_offset_mm = 100.0 * noise.uniform();
            AxisPositions q;
            q[Axis::X] = 10.0, q[Axis::Y] = -20.0, q[Axis::Z] = 30.0;
            q[Axis::C] = 6.0 * (noise.uniform() - 0.5);
            q[tilt] = 3.0 * (noise.uniform() - 0.5);
            const Vector3 tool(0.0, 0.0, 150.0);
            const Vector3 p = pivot.tool_offset_mm + pivot.holder_offset_mm * pivot.tool_direction;
            const Vector3& d = pivot.tool_second_offset_mm;
            const Matrix3 swing = tilt == Axis::A ? rx(q[tilt]) : ry(q[tilt]);
            const Vector3 expected =
                Vector3(10.0, -20.0, 30.0) + p + rz(q[Axis::C]) * (-d + swing * (d - p - tool));
            CHECK((positioning::RotaryTransform(pivot).tip_W(q, tool) - expected).norm() < 1e-10);
        }
}

TEST_CASE("the tool along an axis leaves that axis where it is") {
    const positioning::RotarySolution keep{0.3, 1.25};
    for (const Axis tilt : {Axis::A, Axis::B}) {
        const auto of_table =
            positioning::RotaryTransform(table(tilt, -1.0)).orient(Vector3::UnitZ(), keep);
        REQUIRE(of_table.size() == 1);
        CHECK(of_table[0] == positioning::RotarySolution{0.0, 1.25});
        const auto of_head =
            positioning::RotaryTransform(head(tilt)).orient(Vector3::UnitZ(), keep);
        REQUIRE(of_head.size() == 1);
        CHECK(of_head[0] == positioning::RotarySolution{0.3, 0.0});
    }
}

TEST_CASE("directions a hair from the singular one keep 1e-12 rad") {
    SeededNoise noise(5);
    offsets::PivotParameters nutating = table(Axis::B, 1.0);
    nutating.first.line = Vector3(0, std::sqrt(0.5), std::sqrt(0.5));
    offsets::PivotParameters mixed = head(Axis::B);
    mixed.unit = offsets::MechanicalUnit::mixed;
    std::swap(mixed.first, mixed.second);
    for (const offsets::PivotParameters& pivot :
         {table(Axis::B, -1.0), table(Axis::A, 1.0), head(Axis::B), nutating, mixed}) {
        const positioning::RotaryTransform belief(pivot);
        for (double tilt = 1.0; tilt > 1e-14; tilt *= 0.1) {
            const double turn = 2 * pi * noise.uniform();
            const Vector3 n(std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn),
                            std::cos(tilt));
            const auto found = belief.orient(n, {});
            REQUIRE_FALSE(found.empty());
            for (const positioning::RotarySolution& s : found)
                CHECK(angle_between(belief.tool_direction_W(belief.with_rotaries({}, s)), n) <
                      (tilt < 1e-10 ? 2e-11 : 1e-12));
        }
    }
}

TEST_CASE("a nutating table reaches its limit of travel and nothing beyond") {
    offsets::PivotParameters nutating = table(Axis::B, 1.0);
    nutating.first.line =
        Vector3(0, std::cos(0.6), std::sin(0.6));  // tilts by at most 2 (90 - 34.4)
    const positioning::RotaryTransform belief(nutating);
    const double most = pi - 2 * 0.6;
    const auto at = [&](double tilt) {
        return belief.orient(Vector3(std::sin(tilt), 0, std::cos(tilt)), {}).size();
    };
    CHECK(at(most - 1e-3) == 2);
    CHECK(at(most + 1e-3) == 0);
    CHECK(at(most) >= 1);
}

TEST_CASE("an angle of zero has no sign, so that nothing shows -0") {
    for (const Axis tilt : {Axis::A, Axis::B})
        for (const double sign : {1.0, -1.0})
            for (const offsets::PivotParameters& pivot : {table(tilt, sign), head(tilt)})
                for (const Vector3& n :
                     {Vector3(0, 0, 1), Vector3(1, 0, 0), Vector3(0, 1, 0), Vector3(-1, 0, 0),
                      Vector3(0, -1, 0), Vector3(0, 0, -1), Vector3(0.6, 0, 0.8),
                      Vector3(-0.6, 0, 0.8), Vector3(0, 0.6, 0.8), Vector3(0, -0.6, 0.8)})
                    for (const positioning::RotarySolution& s :
                         positioning::RotaryTransform(pivot).orient(n, {})) {
                        if (s.first_rad == 0.0) CHECK_FALSE(std::signbit(s.first_rad));
                        if (s.second_rad == 0.0) CHECK_FALSE(std::signbit(s.second_rad));
                    }
}

TEST_CASE("a tool from straight below tilts by +180 degrees, never by -180") {
    for (const Axis tilt : {Axis::A, Axis::B})
        for (const double sign : {1.0, -1.0})
            for (const offsets::PivotParameters& pivot : {table(tilt, sign), head(tilt)}) {
                const auto found =
                    positioning::RotaryTransform(pivot).orient(-Vector3::UnitZ(), {});
                REQUIRE_FALSE(found.empty());
                for (const positioning::RotarySolution& s : found) {
                    const double tilt_rad = pivot.unit == offsets::MechanicalUnit::tool_tool
                                                ? s.second_rad
                                                : s.first_rad;
                    CHECK(tilt_rad == Approx(pi));
                }
            }
}

TEST_CASE("parallel axes orient nothing") {
    offsets::PivotParameters pivot = table(Axis::B, 1.0);
    pivot.second.line = Vector3::UnitY();
    CHECK(positioning::RotaryTransform(pivot).orient(Vector3::UnitX(), {}).empty());
}

TEST_CASE("a hypothetical axis stands where 19685 or 19690 says") {
    offsets::PivotParameters wedge = table(Axis::B, 1.0);  // C on a fixed wedge of 30 deg about Y
    wedge.first.hypothetical = true;
    wedge.first.hypothetical_rad = pi / 6;
    wedge.table_offset_mm = {0, 0, 100};
    const positioning::RotaryTransform belief(wedge);
    CHECK(belief.pose_MW({}).rotation.isIdentity(1e-15));
    CHECK(belief.pose_MW({}).translation_mm.norm() < 1e-13);
    AxisPositions q;
    q[Axis::B] = 0.7;  // not this machine's axis
    q[Axis::C] = 1.0;
    const Vector3 axis(0.5, 0, std::sqrt(0.75));
    const Pose expected = Pose::turn(axis, Vector3(50, 0, 100 * std::sqrt(0.75)), 1.0);
    CHECK((belief.pose_MW(q).rotation - expected.rotation).norm() < 1e-14);
    CHECK((belief.pose_MW(q).translation_mm - expected.translation_mm).norm() < 1e-12);
    const auto found = belief.orient(belief.tool_direction_W(q), belief.rotaries(q));
    REQUIRE(found.size() == 1);
    CHECK(found[0].second_rad == Approx(1.0).margin(1e-12));

    offsets::PivotParameters angle_head =
        head(Axis::B);  // C spindle with a fixed 90 deg angle head
    angle_head.second.hypothetical = true;
    angle_head.second.hypothetical_rad = pi / 2;
    const positioning::RotaryTransform angled(angle_head);
    CHECK((angled.tool_direction_W({}) - Vector3::UnitX()).norm() < 1e-15);
    const auto sideways = angled.orient(Vector3(0, -1, 0), angled.rotaries({}));
    REQUIRE(sideways.size() == 1);
    CHECK(sideways[0].first_rad == Approx(-pi / 2));
    CHECK(angled.orient(Vector3::UnitZ(), angled.rotaries({})).empty());

    // -180 and +180 degrees are one angle.
    for (const double turned_rad : {pi, -pi}) {
        angle_head.second.hypothetical_rad = turned_rad;
        const positioning::RotaryTransform upside_down(angle_head);
        const Vector3 tool_W = upside_down.tool_direction_W({});
        CHECK((tool_W + Vector3::UnitZ()).norm() < 1e-15);
        CHECK_FALSE(upside_down.orient(tool_W, upside_down.rotaries({})).empty());
    }
}

TEST_CASE("derivatives against central differences") {
    SeededNoise noise(9);
    offsets::PivotParameters mixed = head(Axis::B);
    mixed.unit = offsets::MechanicalUnit::mixed;
    std::swap(mixed.first, mixed.second);
    for (offsets::PivotParameters pivot : {table(Axis::B, -1.0), head(Axis::A), mixed}) {
        pivot.first.line = random_vector(noise, 2).normalized();
        pivot.table_point_mm = random_vector(noise, 200);
        pivot.table_offset_mm = random_vector(noise, 200);
        pivot.tool_offset_mm = random_vector(noise, 200);
        pivot.tool_second_offset_mm = random_vector(noise, 200);
        const positioning::RotaryTransform belief(pivot);
        const Vector3 tool = random_vector(noise, 200);
        AxisPositions q;
        for (double& value : q.value) value = 3 * noise.normal();
        const positioning::TipDerivative analytic = belief.derivative(q, tool);
        const Axis axes[5] = {Axis::X, Axis::Y, Axis::Z, pivot.first.axis, pivot.second.axis};
        for (int i = 0; i < 5; ++i) {
            const double h = 1e-5;
            AxisPositions up = q, down = q;
            up[axes[i]] += h;
            down[axes[i]] -= h;
            const Vector3 tip = (belief.tip_W(up, tool) - belief.tip_W(down, tool)) / (2 * h);
            CHECK((analytic.tip.col(i) - tip).norm() < 1e-6);
            if (i < 3) continue;
            const Vector3 turn =
                (belief.tool_direction_W(up) - belief.tool_direction_W(down)) / (2 * h);
            CHECK((analytic.direction.col(i - 3) - turn).norm() < 1e-8);
        }
    }
}

}  // namespace trunnion

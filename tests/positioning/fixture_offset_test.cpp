// G54.2: the offset that turns with the table.
#include "positioning/fixture_offset.h"

#include <catch2/catch.hpp>

#include "positioning/rotary_transform.h"
#include "tests/support/alarm_of.h"
#include "tests/support/tables.h"

namespace trunnion {

namespace {

constexpr double deg = pi / 180.0;

const std::vector<Axis> bc_order{Axis::X, Axis::Y, Axis::Z, Axis::B, Axis::C};

}  // namespace

TEST_CASE("G54.2 vector is R(theta) R(theta0)^-1 f0 of the table") {
    SeededNoise noise(6);
    const positioning::RotaryTransform belief(bc_table());
    offsets::Parameters p;
    const positioning::FixtureSettings settings = positioning::decode_fixture_settings(p, bc_order);
    CHECK(settings.assumed);
    for (int k = 0; k < 500; ++k) {
        offsets::FixtureOffset fixture;
        const Vector3 f0 = random_vector(noise, 300);
        fixture.offset[Axis::X] = f0.x();
        fixture.offset[Axis::Y] = f0.y();
        fixture.offset[Axis::Z] = f0.z();
        offsets::OffsetVector now;
        AxisPositions q, q0;
        for (const Axis axis : {Axis::B, Axis::C}) {
            fixture.reference_angles[axis] = 400 * (noise.uniform() - 0.5);
            now[axis] = 2000 * (noise.uniform() - 0.5);
            q[axis] = now[axis] * deg;
            q0[axis] = fixture.reference_angles[axis] * deg;
        }
        const Vector3 expected =
            belief.pose_MW(q).rotation * belief.pose_MW(q0).rotation.transpose() * f0;
        const offsets::OffsetVector f = positioning::turned_fixture_offset(settings, fixture, now);
        CHECK((Vector3(f[Axis::X], f[Axis::Y], f[Axis::Z]) - expected).norm() < 1e-10);
        CHECK(f[Axis::B] == 0.0);
    }
}

TEST_CASE("G54.2 groups and FAX as typed") {
    offsets::Parameters p;
    p.set(7580, 5);  // C carries +X to +Y: a right-handed table
    p.set(7581, 1);
    p.set(7582, 2);
    p.entry[7575].by_axis = {{1, 1.0}, {2, 0.0}};
    const positioning::FixtureSettings settings = positioning::decode_fixture_settings(p, bc_order);
    CHECK_FALSE(settings.assumed);
    offsets::FixtureOffset fixture;
    fixture.offset[Axis::X] = 10;
    fixture.offset[Axis::Z] = 7;
    offsets::OffsetVector now;
    now[Axis::C] = 60;
    now[Axis::B] = 45;  // no group: does not turn the offset
    const offsets::OffsetVector f = positioning::turned_fixture_offset(settings, fixture, now);
    CHECK(f[Axis::X] == Approx(5));
    CHECK(f[Axis::Y] == 0.0);  // 7575#0 of Y is off
    CHECK(f[Axis::Z] == 0.0);
    for (const int number : {7580, 7584, 7588}) {  // any one of them, typed as 0: no group turns
        offsets::Parameters one;
        one.set(number, 0);
        CHECK_FALSE(positioning::decode_fixture_settings(one, bc_order).assumed);
    }
    p.set(7581, 4);
    CHECK(alarm_of([&] { positioning::decode_fixture_settings(p, bc_order); }) == 5459);
    p.set(7581, 2);
    CHECK(alarm_of([&] { positioning::decode_fixture_settings(p, bc_order); }) == 5459);
}

}  // namespace trunnion

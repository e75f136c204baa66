#include "probe/touch_probe.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "base/random.h"
#include "base/units.h"

using namespace trunnion;

TEST_CASE("a straight path touches where the quadratic equation says") {
    SeededNoise noise(3);
    const double reach = 15.7;
    int touched = 0;
    for (int i = 0; i < 500; ++i) {
        const Vector3 from(100 * noise.normal(), 100 * noise.normal(), 100 * noise.normal());
        const Vector3 to(20 * noise.normal(), 20 * noise.normal(), 20 * noise.normal());
        const Vector3 d = to - from;
        if (from.norm() < reach) continue;
        const double a = d.squaredNorm(), b = from.dot(d), c = from.squaredNorm() - reach * reach;
        const double root = b * b - a * c;
        const double expected = root < 0 ? 2.0 : (-b - std::sqrt(root)) / a;
        const auto s = probe::first_contact([&](double t) { return Vector3(from + t * d); }, reach);
        if (expected < 0 || expected > 1) {
            CHECK_FALSE(s);
        } else {
            REQUIRE(s);
            CHECK(std::abs(*s - expected) * d.norm() < 1e-9);
            ++touched;
        }
    }
    CHECK(touched > 80);
}

TEST_CASE("a grazing touch is not stepped over") {
    const double reach = 15.0;
    for (const double depth : {1e-2, 1e-4, 2e-6}) {
        const auto path = [&](double t) { return Vector3(200 * t - 100, reach - depth, 0); };
        const auto s = probe::first_contact(path, reach);
        REQUIRE(s);
        CHECK(std::abs(path(*s).norm() - reach) < 1e-9);
        CHECK(path(*s).x() < 0.0);
    }
    CHECK_FALSE(probe::first_contact(
        [&](double t) { return Vector3(200 * t - 100, reach + 1e-6, 0); }, reach));
}

TEST_CASE("curved paths: the first of many contacts, to 1e-9 mm") {
    const double reach = 10.0;
    const auto path = [](double t) {  // several loops that drift towards the sphere
        const double a = 2 * pi * 5 * t;
        return Vector3(40 - 25 * t + 8 * std::cos(a), 8 * std::sin(a), 3 * t);
    };
    const auto s = probe::first_contact(path, reach);
    REQUIRE(s);
    CHECK(std::abs(path(*s).norm() - reach) < 1e-9);
    for (int i = 0; i < 5000; ++i) CHECK(path(*s * i / 5001.0).norm() > reach);
}

TEST_CASE("in contact at the start, and no motion at all") {
    CHECK(probe::first_contact([](double) { return Vector3(1, 0, 0); }, 2.0).value() == 0.0);
    CHECK_FALSE(probe::first_contact([](double) { return Vector3(3, 0, 0); }, 2.0));
}

TEST_CASE("the way to a sphere in closed form is that of the search along the path") {
    SeededNoise noise(5);
    int met = 0;
    for (int i = 0; i < 300; ++i) {
        const Vector3 from(60 + 10 * noise.normal(), 8 * noise.normal(), 8 * noise.normal());
        const probe::WayToSphere way = probe::way_to_sphere(from, -Vector3::UnitX(), 15.7);
        const auto s =
            probe::first_contact([&](double t) { return from - 100 * t * Vector3::UnitX(); }, 15.7);
        REQUIRE(way.meets == s.has_value());
        if (!s) continue;
        CHECK(std::abs(way.way_mm - 100.0 * *s) < 1e-9);
        ++met;
    }
    CHECK(met > 100);
    CHECK_FALSE(probe::way_to_sphere(Vector3(50, 20, 0), -Vector3::UnitX(), 15.7).meets);
    CHECK(probe::way_to_sphere(Vector3(50, 20, 0), -Vector3::UnitX(), 15.7).way_mm == 50.0);
}

TEST_CASE("the separation comes from the physical machine") {
    kinematics::Machine machine;
    machine.chain = kinematics::parse_chain("w C b X Y Z t");
    const probe::TouchProbe probe{Vector3(0, 0, -150), 6.0};
    const probe::SphereTarget sphere{Vector3(100, 0, 50), 25.4};
    AxisPositions q;
    q[Axis::Z] = 200;
    q[Axis::C] = pi / 2;  // the table turns by -90 degrees: the sphere stands at (0, -100, 50)
    CHECK((centre_to_tip_M(machine.poses(q), probe, sphere) - Vector3(0, 100, 0)).norm() < 1e-12);
}

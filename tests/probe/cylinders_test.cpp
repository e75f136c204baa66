// Tools against the disc of a setter, at any angle: closed forms of planes, rims and sides.
#include "probe/cylinders.h"

#include <catch2/catch.hpp>
#include <cmath>

namespace trunnion {

namespace {

constexpr double exact = 1e-9;  // mm

/// 8 mm high, its top at zero.
probe::Cylinder disc(double radius_mm) {
    return {{0, 0, -8}, Vector3::UnitZ(), 8, radius_mm};
}

/// Where along `way` the tool's tip stands at the contact, mm from the start.
double contact_mm(const probe::Cylinder& still, const probe::Cylinder& start, const Vector3& way) {
    const auto s = probe::first_contact(still, [&](double t) {
        probe::Cylinder tool = start;
        tool.end_mm += t * way;
        return tool;
    });
    REQUIRE(s);
    return *s * way.norm();
}

}  // namespace

TEST_CASE("a leaning tool comes down on its rim") {
    for (const double lean_rad : {1e-9, 1e-5, 0.0017, -0.05, 0.4, -1.1}) {
        for (const double radius_mm : {0.02, 0.5, 8.0}) {
            INFO("lean " << lean_rad << ", radius " << radius_mm);
            const Vector3 axis(std::sin(lean_rad), 0.0, std::cos(lean_rad));
            const probe::Cylinder tool{20.0 * axis, axis, 60, radius_mm};
            // The lowest point of the rim is radius * sin below the tip; the way has cos in Z.
            CHECK(contact_mm(disc(60), tool, -40.0 * axis) ==
                  Approx(20.0 - radius_mm * std::tan(std::abs(lean_rad))).margin(exact));
        }
    }
}

TEST_CASE("a leaning tool meets the upper rim of a disc with its side") {
    // Moved along X, leaning in X: the axis at height z stands tip + z tan beside, the side is
    // radius / cos from it at that height. The rim is 10 from the middle.
    for (const double lean_rad : {1e-6, 0.003, 0.3}) {
        INFO("lean " << lean_rad);
        const Vector3 axis(std::sin(lean_rad), 0.0, std::cos(lean_rad));
        const probe::Cylinder tool{{-40, 0, -3}, axis, 60, 4};
        CHECK(contact_mm(disc(10), tool, {60, 0, 0}) ==
              Approx(30.0 - 4.0 / std::cos(lean_rad) - 3.0 * std::tan(lean_rad)).margin(exact));
    }
}

TEST_CASE("two crossed sides meet as far apart as both radii") {
    const probe::Cylinder lying{{-50, 0, 0}, Vector3::UnitX(), 100, 5};
    const Vector3 axis = Vector3(0.3, 1.0, 0.0).normalized();
    const probe::Cylinder other{Vector3(0, 0, 30) - 40.0 * axis, axis, 80, 3};
    CHECK(probe::clearance_mm(lying, other) <= 22.0 + exact);
    CHECK(contact_mm(lying, other, {0, 0, -40}) == Approx(22.0).margin(exact));
}

TEST_CASE("two rims meet in a point") {
    // In the plane of both axes: the lower corner of the tool against the corner of the disc.
    const double lean_rad = 0.2, radius_mm = 6.0;
    const Vector3 axis(std::sin(lean_rad), 0.0, std::cos(lean_rad));
    const Vector3 corner = radius_mm * Vector3(std::cos(lean_rad), 0.0, -std::sin(lean_rad));
    const Vector3 way(3.0, 0.0, -4.0);
    const Vector3 start = Vector3(-10.0, 0.0, 0.0) - corner - 2.0 * way;
    CHECK(contact_mm(disc(10), {start, axis, 60, radius_mm}, 4.0 * way) ==
          Approx(2.0 * way.norm()).margin(exact));
}

TEST_CASE("a tool beside the disc passes it, one in it touches at once") {
    const Vector3 axis = Vector3(0.02, -0.01, 1.0).normalized();
    const auto moving = [&](const Vector3& from) {
        return [=](double s) {
            return probe::Cylinder{from + s * Vector3(0, 0, -30), axis, 60, 4};
        };
    };
    CHECK_FALSE(probe::first_contact(disc(10), moving({14.7, 0, 20})));
    CHECK(probe::first_contact(disc(10), moving({13.0, 0, 20})));
    CHECK(*probe::first_contact(disc(10), moving({5.0, 0, -2})) == 0.0);
}

}  // namespace trunnion

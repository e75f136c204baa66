#include "geometry/plane_path.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "base/units.h"

using namespace trunnion;

TEST_CASE("the sweep of an arc has the sense that was asked, and equal ends are a full turn") {
    const PlanePoint centre{3, -2};
    for (const double from_deg : {0.0, 30.0, 135.0, -170.0}) {
        for (const double sweep_deg : {1.0, 90.0, 179.0, 181.0, 300.0}) {
            INFO(from_deg << " " << sweep_deg);
            const auto at = [&](double deg) {
                return centre +
                       5.0 * PlanePoint{std::cos(rad_from_deg(deg)), std::sin(rad_from_deg(deg))};
            };
            const double sweep_rad = rad_from_deg(sweep_deg);
            const PlanePoint end = at(from_deg + sweep_deg);
            CHECK(sweep_of(centre, at(from_deg), end, false) == Approx(sweep_rad));
            CHECK(sweep_of(centre, at(from_deg), end, true) == Approx(sweep_rad - 2.0 * pi));
        }
    }
    CHECK(sweep_of(centre, {8, -2}, {8, -2}, false) == Approx(2.0 * pi));
    CHECK(sweep_of(centre, {8, -2}, {8, -2}, true) == Approx(-2.0 * pi));
}

TEST_CASE("an arc offset to its left shrinks counter-clockwise and grows clockwise") {
    PlaneElement arc{{5, 0}, {0, 5}, true, {0, 0}, pi / 2};
    CHECK(offset_radius(arc, 1.0) == Approx(4.0));
    CHECK(offset_radius(arc, -1.0) == Approx(6.0));
    CHECK(tangent_at_start(arc).y == Approx(1.0));
    CHECK(tangent_at_end(arc).x == Approx(-1.0));
    arc.sweep_rad = -1.5 * pi;
    CHECK(offset_radius(arc, 1.0) == Approx(6.0));
    CHECK(tangent_at_start(arc).y == Approx(-1.0));
}

TEST_CASE("offset elements meet where their offset curves do") {
    const PlaneElement along_x{{0, 0}, {10, 0}, false, {}, 0.0};
    const PlaneElement along_y{{10, 0}, {10, 10}, false, {}, 0.0};
    const auto inside = offset_meeting(along_x, 2.0, along_y, 3.0, {10, 0});
    REQUIRE(inside);
    CHECK(inside->x == Approx(7.0));
    CHECK(inside->y == Approx(2.0));
    // The line 2 above the centre and the circle of radius 5 - 1 about it.
    const PlaneElement arc{{15, 0}, {10, 5}, true, {10, 0}, pi / 2};
    const auto on_arc = offset_meeting(along_x, 2.0, arc, 1.0, {15, 0});
    REQUIRE(on_arc);
    CHECK(on_arc->y == Approx(2.0));
    CHECK(on_arc->x == Approx(10.0 + std::sqrt(12.0)));
    CHECK_FALSE(offset_meeting(along_x, 5.0, arc, 1.0, {15, 0}));
}

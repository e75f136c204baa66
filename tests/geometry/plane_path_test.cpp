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

TEST_CASE("a line and an arc meet in that of two points which is nearer to the corner") {
    // The line 2 above the centre cuts the circle of radius 5 - 1 on both sides of it.
    for (const double side : {1.0, -1.0})
        for (const double way : {1.0, -1.0}) {
            const PlanePoint corner{10.0 + 5.0 * side, 0.0};
            const PlaneElement line{{10.0 - 20.0 * way, 0}, corner, false, {}, 0.0};
            const PlaneElement arc{corner, {10, 5}, true, {10, 0}, side * pi / 2};
            const auto met = offset_meeting(line, 2.0 * way, arc, side, corner);
            REQUIRE(met);
            INFO(side << " " << way);
            CHECK(met->x == Approx(10.0 + side * std::sqrt(12.0)));
            CHECK(met->y == Approx(2.0));
        }
}

TEST_CASE("tangents of an arc stand square to its radius, wherever its centre is") {
    const PlaneElement arc{{13, 4}, {10, 9}, true, {10, 4}, pi / 2};
    CHECK(tangent_at_start(arc).x == Approx(0.0).margin(1e-12));
    CHECK(tangent_at_start(arc).y == Approx(1.0));
    CHECK(tangent_at_end(arc).x == Approx(-1.0));
    CHECK(tangent_at_end(arc).y == Approx(0.0).margin(1e-12));
}

TEST_CASE("an offset line that only touches the offset circle meets it there") {
    // The line 5 above the centre touches the circle of radius 6 - 1.
    const PlaneElement line{{0, 0}, {16, 0}, false, {}, 0.0};
    const PlaneElement arc{{16, 0}, {10, 6}, true, {10, 0}, pi / 2};
    const auto touched = offset_meeting(line, 5.0, arc, 1.0, {16, 0});
    REQUIRE(touched);
    CHECK(touched->x == Approx(10.0));
    CHECK(touched->y == Approx(5.0));
}

TEST_CASE("offset arcs meet in that of two points which is nearer to the corner") {
    // Half circles of radius 5 about (0, 0) and (8, 0), from the corner (4, 3) or (4, -3), here and
    // elsewhere in the plane.
    for (const double side : {1.0, -1.0})
        for (const PlanePoint from : {PlanePoint{0, 0}, PlanePoint{30, -70}}) {
            const PlanePoint corner = from + PlanePoint{4, 3 * side};
            const PlaneElement first{from + PlanePoint{-5, 0}, corner, true, from, -1.0};
            const PlaneElement second{corner, from + PlanePoint{13, 0}, true,
                                      from + PlanePoint{8, 0}, -1.0};
            for (const double offset : {0.0, 1.0, -0.5}) {
                const auto at = offset_meeting(first, offset, second, offset, corner);
                REQUIRE(at);
                const PlanePoint seen = *at - from;
                CHECK(seen.x == Approx(4.0));
                CHECK(seen.y == Approx(side * std::sqrt((5 + offset) * (5 + offset) - 16)));
            }
            CHECK_FALSE(offset_meeting(first, -1.5, second, -1.5, corner));  // apart
        }
    const PlaneElement beside{{-5, 0}, {5, 0}, true, {0, 0}, -pi};
    const PlaneElement next{{5, 0}, {15, 0}, true, {10, 0}, pi};  // they touch from outside
    const auto touched = offset_meeting(beside, 0.0, next, 0.0, {5, 0});
    REQUIRE(touched);
    CHECK(length_of(*touched - PlanePoint{5, 0}) < 1e-9);
    const PlaneElement outer{{0, -5}, {5, 0}, true, {0, 0}, 1.5};
    const PlaneElement inner{{5, 0}, {1, 0}, true, {3, 0}, 3.1};  // touches from inside
    const auto at = offset_meeting(outer, 1.0, inner, 1.0, {5, 0});
    REQUIRE(at);
    CHECK(at->x == Approx(4.0));
    CHECK(std::abs(at->y) < 1e-6);
    CHECK_FALSE(offset_meeting(outer, 0.0, inner, 1.0, {5, 0}));  // one inside the other
    CHECK_FALSE(offset_meeting(outer, 1.0, outer, 1.0, {5, 0}));  // the same circle
}

TEST_CASE("a line moves unless it ends where it starts, wherever that is") {
    CHECK_FALSE(PlaneElement{{5, 2}, {5, 2}, false, {}, 0.0}.moves());
    CHECK(PlaneElement{{5, 2}, {-5, -2}, false, {}, 0.0}.moves());
    CHECK(PlaneElement{{5, 2}, {5, 2}, true, {0, 2}, 2.0 * pi}.moves());
}

TEST_CASE("a part of an arc keeps its centre and turns by its own angle") {
    const PlaneElement arc{{5, 0}, {0, 5}, true, {0, 0}, pi / 2};
    const double c = 5 * std::sqrt(0.5);
    CHECK(between(arc, {5, 0}, {c, c}).sweep_rad == Approx(pi / 4));
    CHECK(between(arc, {c, c}, {0, 5}).sweep_rad == Approx(pi / 4));
    CHECK(between(arc, {5, 0}, {-c, c}).sweep_rad == Approx(3 * pi / 4));
    const PlaneElement clockwise{{0, 5}, {5, 0}, true, {0, 0}, -pi / 2};
    CHECK(between(clockwise, {c, c}, {5, 0}).sweep_rad == Approx(-pi / 4));
    const PlaneElement elsewhere{{25, 7}, {20, 12}, true, {20, 7}, pi / 2};
    CHECK(between(elsewhere, {20 + c, 7 + c}, {20, 12}).sweep_rad == Approx(pi / 4));
    CHECK(between({{0, 0}, {9, 0}, false, {}, 0.0}, {1, 0}, {2, 0}).sweep_rad == 0.0);
}

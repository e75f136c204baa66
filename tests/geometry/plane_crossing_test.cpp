// Whether two elements cross: single cases, and random ones against points sampled on one of them.
#include "geometry/plane_crossing.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <optional>

#include "base/random.h"
#include "base/units.h"

using namespace trunnion;

namespace {

PlaneElement line(PlanePoint start, PlanePoint end) {
    return {start, end, false, {}, 0.0};
}

PlanePoint turned(PlanePoint v, double angle_rad) {
    const double c = std::cos(angle_rad), s = std::sin(angle_rad);
    return {c * v.x - s * v.y, s * v.x + c * v.y};
}

PlaneElement arc(PlanePoint centre, PlanePoint start, double sweep_rad) {
    return {start, centre + turned(start - centre, sweep_rad), true, centre, sweep_rad};
}

PlanePoint point_at(const PlaneElement& e, double part) {
    return e.arc ? e.centre + turned(e.start - e.centre, part * e.sweep_rad)
                 : e.start + part * (e.end - e.start);
}

/// Distance from the whole line or circle of an element, with a sign by side.
double off(const PlaneElement& e, PlanePoint p) {
    if (e.arc) return length_of(p - e.centre) - e.radius();
    return cross((1.0 / length_of(e.end - e.start)) * (e.end - e.start), p - e.start);
}

/// Where a point of the line or circle stands on the element: 0 at the start, 1 at the end.
double part_of(const PlaneElement& e, PlanePoint p) {
    if (!e.arc) return dot(p - e.start, e.end - e.start) / dot(e.end - e.start, e.end - e.start);
    const PlanePoint u = e.start - e.centre, v = p - e.centre;
    const double angle = std::atan2(cross(u, v), dot(u, v)) * (e.sweep_rad < 0.0 ? -1.0 : 1.0);
    return (angle < 0.0 ? angle + 2.0 * pi : angle) / std::abs(e.sweep_rad);
}

/// By 500 points of `a`; nothing where they cannot tell: near a tangency or near an end.
std::optional<bool> sampled_crossing(const PlaneElement& a, const PlaneElement& b) {
    constexpr int steps = 500;
    bool crosses = false;
    for (int k = 0; k < steps; ++k) {
        double low = double(k) / steps, high = double(k + 1) / steps;
        const double side = off(b, point_at(a, low)), other = off(b, point_at(a, high));
        if (side * other > 0.0) {
            if (std::min(std::abs(side), std::abs(other)) < 1e-3) return std::nullopt;
            continue;
        }
        for (int halved = 0; halved < 40; ++halved) {
            const double middle = 0.5 * (low + high);
            (off(b, point_at(a, middle)) * side > 0.0 ? low : high) = middle;
        }
        const double part = part_of(b, point_at(a, low));
        if (part < 0.0 || part > 1.0) {
            if (part > -0.01 && part < 1.01) return std::nullopt;
            continue;
        }
        crosses = true;
    }
    return crosses;
}

PlaneElement random_element(SeededNoise& noise) {
    const auto place = [&] { return PlanePoint{8.0 * noise.uniform(), 8.0 * noise.uniform()}; };
    if (noise.uniform() < 0.4) return line(place(), place());
    const PlanePoint centre = place();
    const double sweep_rad = (0.2 + 6.0 * noise.uniform()) * (noise.uniform() < 0.5 ? -1.0 : 1.0);
    return arc(centre, place(), sweep_rad);
}

}  // namespace

TEST_CASE("random lines and arcs cross where points sampled on one of them change sides") {
    SeededNoise noise(5);
    int crossing = 0, apart = 0;
    for (int k = 0; k < 3000; ++k) {
        const PlaneElement a = random_element(noise), b = random_element(noise);
        const auto expected = sampled_crossing(a, b);
        if (!expected) continue;
        INFO(k);
        CHECK(cross_over(a, b) == *expected);
        CHECK(cross_over(b, a) == *expected);
        CHECK(touch(a, b) == *expected);
        ++(*expected ? crossing : apart);
    }
    CHECK(crossing > 500);
    CHECK(apart > 500);
}

TEST_CASE("an element that only touches another touches it and does not cross it") {
    const PlaneElement circle = arc({10, 0}, {10, 5}, -2.0 * pi);
    CHECK_FALSE(cross_over(line({0, 5}, {20, 5}), circle));  // tangent
    CHECK_FALSE(cross_over(circle, arc({20, 0}, {15, 0}, pi)));
    CHECK_FALSE(cross_over(circle, arc({13, 0}, {15, 0}, pi)));  // from inside
    CHECK(touch(circle, arc({20, 0}, {15, 0}, pi)));
    CHECK_FALSE(touch(circle, arc({20, 0}, {15.1, 0}, pi)));
    CHECK(touch(line({0, 0}, {5, 0}), circle));  // ends on it
    CHECK(cross_over(line({0, 0}, {5, 0}), circle));
    CHECK_FALSE(touch(line({0, 0}, {4.9, 0}), circle));
    CHECK(touch(line({0, 0}, {9, 0}), line({9, 0}, {20, 0})));  // one goes on from the other
    CHECK(touch(line({30, 7}, {39, 7}), line({39, 7}, {50, 7})));
    CHECK_FALSE(touch(line({30, 7}, {39, 7}), line({39, -7}, {50, -7})));
    CHECK_FALSE(touch(line({0, 0}, {9, 0}), line({0, 1}, {9, 1})));
    CHECK(touch(line({0, 0}, {9, 0}), line({4, 0}, {20, 0})));  // one lies on the other
    CHECK_FALSE(cross_over(line({0, 0}, {9, 0}), line({4, 0}, {20, 0})));
}

TEST_CASE("an element that starts at the end of the one before does not cross it there") {
    const PlaneElement first = line({0, 0}, {9, 0});
    CHECK_FALSE(cross_over(first, line({9, 0}, {9, 9})));
    CHECK(cross_over(first, line({5, 0}, {9, 9})));
    CHECK(cross_over(line({9, 0}, {9, 9}), first));
    // The arc comes back over the line at (1, 0).
    CHECK(cross_over(first, arc({5, 0}, {9, 0}, 1.5 * pi)));
    CHECK_FALSE(cross_over(first, arc({5, 0}, {9, 0}, 0.9 * pi)));
}

TEST_CASE("a point is an element, too") {
    const PlaneElement point = line({3, 0}, {3, 0});
    CHECK(touch(point, line({0, 0}, {9, 0})));
    CHECK(touch(line({0, 0}, {9, 0}), point));
    CHECK_FALSE(touch(point, line({0, 1}, {9, 1})));
    CHECK_FALSE(cross_over(point, line({0, 0}, {9, 0})));
}

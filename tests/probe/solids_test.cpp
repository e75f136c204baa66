// Exact distances to boxes and rings, and contacts of a ball against closed forms.
#include "probe/solids.h"

#include <catch2/catch.hpp>
#include <cmath>

namespace trunnion {

namespace {

constexpr double root = 1e-9;

double contact_x(const probe::Solid& solid, const Vector3& from, const Vector3& to, double radius) {
    const auto s = probe::first_contact(
        std::span(&solid, 1), [&](double t) { return Vector3(from + t * (to - from)); }, radius);
    return s ? (from + *s * (to - from)).x() : std::nan("");
}

}  // namespace

TEST_CASE("a ball meets the face, the edge and the corner of a box") {
    const probe::Solid box{false, {-10, -10, -20}, {10, 10, 0}, 0, 0};
    CHECK(probe::distance_mm(box, {13, 0, -5}) == 3.0);
    CHECK(probe::distance_mm(box, {13, 14, -5}) == 5.0);
    CHECK(probe::distance_mm(box, {12, 13, 6}) == 7.0);
    CHECK(probe::distance_mm(box, {9, 0, -5}) == -1.0);
    CHECK(std::abs(contact_x(box, {30, 0, -5}, {0, 0, -5}, 3.0) - 13.0) < root);
    // 2 mm above the top: the ball of 3 mm meets the edge.
    CHECK(std::abs(contact_x(box, {30, 0, 2}, {0, 0, 2}, 3.0) - (10.0 + std::sqrt(5.0))) < root);
    // 1 beside the side and 2 above: the corner.
    CHECK(std::abs(contact_x(box, {30, 11, 2}, {0, 11, 2}, 3.0) - 12.0) < root);
    CHECK(std::isnan(contact_x(box, {30, 0, 3.001}, {0, 0, 3.001}, 3.0)));
}

TEST_CASE("a ball meets a boss from outside and a ring from inside") {
    const probe::Solid boss{true, {0, 0, -20}, {0, 0, 0}, 0, 12.5};
    CHECK(std::abs(contact_x(boss, {30, 4, -5}, {-30, 4, -5}, 3.0) -
                   std::sqrt(15.5 * 15.5 - 16.0)) < root);
    const probe::Solid ring{true, {0, 0, -20}, {0, 0, 0}, 25.0, 35.0};
    CHECK(std::abs(contact_x(ring, {0, 6, -5}, {30, 6, -5}, 3.0) - std::sqrt(22.0 * 22.0 - 36.0)) <
          root);
    CHECK(probe::distance_mm(ring, {30, 0, 4}) == 4.0);
    CHECK(probe::distance_mm(ring, {0, 0, -5}) == 25.0);
}

TEST_CASE("a ball in contact at the start stops at once, one that stands meets nothing") {
    const probe::Solid box{false, {-10, -10, -20}, {10, 10, 0}, 0, 0};
    CHECK(contact_x(box, {12, 0, -5}, {0, 0, -5}, 3.0) == 12.0);
    CHECK(std::isnan(contact_x(box, {30, 0, -5}, {30, 0, -5}, 3.0)));
}

}  // namespace trunnion

#include "pivot/pivot_maps.h"

#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "base/random.h"
#include "base/units.h"

using namespace trunnion;

namespace {

Vector3 random_vector(SeededNoise& noise, double size) {
    return size * Vector3(noise.normal(), noise.normal(), noise.normal());
}

/// Closed forms of pivot 2021 as docs/notation.md writes them: intersecting axes, table axes
/// turning against the tool.
Vector3 boxed(const Vector3& dg, const Vector3& dp, const Vector3& dd, bool g54, double b,
              double c) {
    const Matrix3 rb = rotation_about(Vector3::UnitY(), -b),
                  rc = rotation_about(Vector3::UnitZ(), -c);
    const Matrix3 one = Matrix3::Identity();
    if (g54) return (rb * rc - one) * dg;
    return (rb * rc - one) * (dp + dd) - (rb - one) * dd;
}

}  // namespace

TEST_CASE("the expected error of a zeroed sphere is the paper's closed form") {
    SeededNoise noise(3);
    for (int i = 0; i < 300; ++i) {
        PivotStores s;
        s.p_true = random_vector(noise, 50.0);
        s.d_true = Vector3::Zero();
        const Vector3 dg = random_vector(noise, 0.2), dp = random_vector(noise, 0.2),
                      dd = random_vector(noise, 0.2);
        s.g54 = s.p_true + dg;
        s.p = s.p_true + dp;
        s.d = dd;
        const Vector3 sphere = random_vector(noise, 150.0);
        const double b = noise.normal(), c = 3.0 * noise.normal();
        for (const bool g54 : {true, false})
            CHECK((expected_error_mm(s, g54, sphere, b, c) - boxed(dg, dp, dd, g54, b, c)).norm() <
                  1e-12);
    }
}

TEST_CASE("equal sums in both stores agree on C arcs and not on B arcs") {
    PivotStores s;
    const Vector3 dp(0.1, 0.05, -0.08), dd(0.07, -0.09, 0.11);
    s.p = dp;
    s.d = dd;
    s.g54 = dp + dd;
    const Vector3 sphere(120, 0, 80);
    double b_apart = 0.0;
    for (double a = -1.5; a <= 1.5; a += 0.25) {
        const auto apart = [&](double b, double c) {
            return (expected_error_mm(s, true, sphere, b, c) -
                    expected_error_mm(s, false, sphere, b, c))
                .norm();
        };
        CHECK(apart(0.0, 2 * a) < 1e-13);
        b_apart = std::max(b_apart, apart(a, 0.0));
    }
    CHECK(b_apart > 0.1);
}

TEST_CASE("the circle radius of an arc is the length of the turning vector") {
    // r_G = |P_z dg| on a C arc; r_P = |P_y dp| on a B arc at C0 (facts of pivot 2021).
    PivotStores s;
    const Vector3 dg(0.12, -0.2, 0.15), dp(0.1, 0.02, -0.14), dd(0.03, 0.04, 0.05);
    s.g54 = dg;
    s.p = dp;
    s.d = dd;
    std::vector<PivotPoint> c_arc, b_arc;
    for (int i = 0; i < 24; ++i)
        c_arc.push_back(
            {0.0, 15.0 * i, expected_error_mm(s, true, {90, 20, 60}, 0.0, rad_from_deg(15.0 * i))});
    for (int i = 0; i < 13; ++i) {
        const double b = -90.0 + 15.0 * i;
        b_arc.push_back({b, 0.0, expected_error_mm(s, false, {90, 20, 60}, rad_from_deg(b), 0.0)});
    }
    CHECK(std::abs(fit_arc_radius_mm(c_arc, Axis::C) - std::hypot(0.12, 0.2)) < 1e-12);
    CHECK(std::abs(fit_arc_radius_mm(b_arc, Axis::B) - std::hypot(0.1, 0.14)) < 1e-12);
    CHECK(fit_arc_radius_mm({c_arc[0], c_arc[1]}, Axis::C) == 0.0);
}

TEST_CASE("printed results become maps") {
    const auto maps = parse_pivot_prints(
        "DPP MAP1 B-  90.0000 C  0.0000 X 0.1000000 Y-0.2000000 Z 0.3000000\n"
        "DPP MAP1 B-75.0000 C  0.0000 X 0.1000000 Y-0.2000000 Z 0.3000000\nnoise\n"
        "TW MAP4 B  0.0000 C 15.0000 X 0.1000000 Y-0.2000000 Z 0.3000000\n"
        "TW MAP4 B  0.0000 C 30.0000 X 0.1000000 Y-0.2000000 Z 0.3000000\n");
    REQUIRE(maps.size() == 2);
    CHECK(maps[0].name == "B arc at C0");
    CHECK(maps[1].moving == Axis::C);
    REQUIRE(maps[0].arcs[0].points.size() == 2);
    CHECK(maps[0].arcs[0].points[0].b_deg == -90.0);
    CHECK(maps[0].arcs[0].points[0].error_mm == Vector3(0.1, -0.2, 0.3));
    CHECK(maps[1].arcs[3].points[1].c_deg == 30.0);
}

#include "geometry/fits.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "base/random.h"
#include "base/units.h"

using namespace trunnion;

namespace {

/// Gander, Golub and Strebel's six points; results of Chernov's own programs (docs/sources.md).
/// His Kasa line (4.921166, 3.835123, 4.123176) does not solve Kasa's own normal equations: the
/// values below come from solving them in exact fractions.
const std::vector<Vector2> gander = {{1, 7}, {2, 6}, {5, 8}, {7, 7}, {9, 5}, {3, 7}};

void require_circle(CircleMethod method, double x, double y, double radius) {
    const auto fit = fit_circle(gander, method);
    REQUIRE(fit);
    CHECK(std::abs(fit->center_mm.x() - x) < 6e-7);
    CHECK(std::abs(fit->center_mm.y() - y) < 6e-7);
    CHECK(std::abs(fit->radius_mm - radius) < 6e-7);
}

std::vector<Vector2> arc(const Vector2& center, double radius, double from_deg, double to_deg,
                         int count) {
    std::vector<Vector2> points;
    for (int i = 0; i < count; ++i) {
        const double a = rad_from_deg(from_deg + (to_deg - from_deg) * i / (count - 1));
        points.push_back(center + radius * Vector2(std::cos(a), std::sin(a)));
    }
    return points;
}

}  // namespace

TEST_CASE("circle fits reproduce Chernov's programs on six points") {
    require_circle(CircleMethod::kasa, 4.742331, 3.835123, 4.108762);
    require_circle(CircleMethod::pratt, 4.615482, 2.807354, 4.911302);
    require_circle(CircleMethod::taubin, 4.613933, 2.795209, 4.879213);
    require_circle(CircleMethod::hyper, 4.615482, 2.807354, 4.827575);
    CHECK(std::abs(fit_circle(gander)->rms_mm - 0.4571757) < 6e-8);
}

TEST_CASE("the rms of a plane is that of the distances from it") {
    const std::vector<Vector3> points = {{0, 0, 1.5}, {10, 0, 0.5}, {10, 10, 1.5}, {0, 10, 0.5}};
    const auto plane = fit_plane(points);
    REQUIRE(plane);
    CHECK((plane->normal - Vector3::UnitZ()).norm() < 1e-12);
    CHECK(plane->rms_mm == Approx(0.5));
}

TEST_CASE("the reference's Kasa line halves one unknown too early") {
    // Cholesky of the centred moments: G G^T (B', C') = (Mxz, Myz), centre = half of (B', C').
    Vector2 mean = Vector2::Zero();
    for (const Vector2& p : gander) mean += p / 6.0;
    double xx = 0, yy = 0, xy = 0, xz = 0, yz = 0;
    for (const Vector2& p : gander) {
        const Vector2 d = p - mean;
        const double z = d.squaredNorm();
        xx += d.x() * d.x(), yy += d.y() * d.y(), xy += d.x() * d.y();
        xz += d.x() * z, yz += d.y() * z;
    }
    const double c = (yz * xx - xz * xy) / (xx * yy - xy * xy);
    CHECK(mean.y() + 0.5 * c == Approx(3.835123).margin(6e-7));
    CHECK(mean.x() + 0.5 * (xz - xy * c) / xx == Approx(4.742331).margin(6e-7));
    CHECK(mean.x() + 0.5 * (xz - xy * 0.5 * c) / xx == Approx(4.921166).margin(6e-7));
}

TEST_CASE("every circle method returns an exact arc far from the origin") {
    const auto points = arc({412.5, -83.25}, 100.0, 20, 75, 40);
    for (const auto method : {CircleMethod::kasa, CircleMethod::pratt, CircleMethod::taubin,
                              CircleMethod::hyper, CircleMethod::geometric}) {
        const auto fit = fit_circle(points, method);
        REQUIRE(fit);
        CHECK((fit->center_mm - Vector2(412.5, -83.25)).norm() < 1e-9);
        CHECK(std::abs(fit->radius_mm - 100.0) < 1e-9);
    }
}

TEST_CASE("points of a line have no plane, however far they reach") {
    for (const double size : {1e-2, 1.0, 1e3}) {
        std::vector<Vector3> points;
        for (int k = 0; k < 20; ++k)
            points.push_back(size *
                             (Vector3(0.3, -0.2, 0.7) + 0.1 * k * Vector3(1.0, 0.37, -0.61)));
        CHECK_FALSE(fit_plane(points));
        points.push_back(points[3] + size * Vector3(0.01, 0.0, 0.02));
        CHECK(fit_plane(points));
    }
}

TEST_CASE("on a noisy short arc the hyper fit is less biased than Kasa's") {
    SeededNoise noise(7);
    double kasa = 0, hyper = 0;
    const int runs = 300;
    for (int run = 0; run < runs; ++run) {
        auto points = arc({0, 0}, 100.0, 0, 60, 50);
        for (auto& p : points) p += 1.0 * Vector2(noise.normal(), noise.normal());
        kasa += (fit_circle(points, CircleMethod::kasa)->radius_mm - 100.0) / runs;
        hyper += (fit_circle(points)->radius_mm - 100.0) / runs;
    }
    CHECK(kasa < -5.0 * std::abs(hyper));
}

TEST_CASE("the geometric circle leaves no gradient") {
    const auto fit = fit_circle(gander, CircleMethod::geometric);
    REQUIRE(fit);
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
    for (const Vector2& p : gander) {
        const Vector2 arm = p - fit->center_mm;
        const double r = arm.norm() - fit->radius_mm;
        gradient += r * Eigen::Vector3d(arm.x() / arm.norm(), arm.y() / arm.norm(), 1.0);
    }
    CHECK(gradient.norm() < 1e-9);
    CHECK(fit->rms_mm < fit_circle(gander)->rms_mm);
}

TEST_CASE("circles that do not exist are said so") {
    const std::vector<Vector2> line = {{0, 0}, {1, 1}, {2, 2}, {5, 5}};
    const std::vector<Vector2> two = {{0, 0}, {1, 1}};
    CHECK_FALSE(fit_circle(line));
    CHECK_FALSE(fit_circle(two));
    const std::vector<Vector2> same(5, Vector2(3, 4));
    REQUIRE(fit_circle(same));
    CHECK(fit_circle(same)->radius_mm == 0.0);
    CHECK((fit_circle(same)->center_mm - Vector2(3, 4)).norm() < 1e-12);
}

TEST_CASE("a small circle of errors keeps its radius") {
    const auto fit = fit_circle(arc({1e-3, 0}, 0.05, 0, 345, 24));
    REQUIRE(fit);
    CHECK(std::abs(fit->radius_mm - 0.05) < 1e-14);
}

namespace {

std::vector<Vector3> nine_touches(const Vector3& center, double radius) {
    std::vector<Vector3> points = {center + radius * Vector3::UnitZ()};
    for (int i = 0; i < 8; ++i) {
        const double e = rad_from_deg(i < 4 ? 45.0 : 15.0);
        const double a = rad_from_deg(i < 4 ? 90.0 * i : 90.0 * i + 45.0);
        points.push_back(center + radius * Vector3(std::cos(e) * std::cos(a),
                                                   std::cos(e) * std::sin(a), std::sin(e)));
    }
    return points;
}

}  // namespace

TEST_CASE("nine touches give the sphere back") {
    const Vector3 center(120, -35, 80.5);
    const auto points = nine_touches(center, 15.7);
    for (const auto& fit :
         {fit_sphere_linear(points), fit_sphere(points), fit_sphere(points, 15.7)}) {
        REQUIRE(fit);
        CHECK((fit->center_mm - center).norm() < 1e-11);
        CHECK(std::abs(fit->radius_mm - 15.7) < 1e-11);
        CHECK(fit->rms_mm < 1e-12);
    }
}

TEST_CASE("a known radius makes the height of a cap surer and the cofactor says by how much") {
    SeededNoise noise(3);
    const Vector3 center(10, 20, 30);
    double free_square = 0, known_square = 0;
    const int runs = 2000;
    for (int run = 0; run < runs; ++run) {
        auto points = nine_touches(center, 15.7);
        for (auto& p : points) p += 1e-3 * noise.normal() * (p - center).normalized();
        free_square += std::pow(fit_sphere(points)->center_mm.z() - 30, 2) / runs;
        known_square += std::pow(fit_sphere(points, 15.7)->center_mm.z() - 30, 2) / runs;
    }
    const auto points = nine_touches(center, 15.7);
    const double free_sigma = 1e-3 * std::sqrt(fit_sphere(points)->cofactor(2, 2));
    const double known_sigma = 1e-3 * std::sqrt(fit_sphere(points, 15.7)->cofactor(2, 2));
    CHECK(known_sigma < 0.6 * free_sigma);
    CHECK(std::abs(std::sqrt(free_square) / free_sigma - 1) < 0.08);
    CHECK(std::abs(std::sqrt(known_square) / known_sigma - 1) < 0.08);
}

TEST_CASE("a sphere needs four points that are not in a plane") {
    const std::vector<Vector3> flat = {{1, 0, 5}, {0, 1, 5}, {-1, 0, 5}, {0, -1, 5}, {0.6, 0.8, 5}};
    CHECK_FALSE(fit_sphere(flat));
    CHECK_FALSE(fit_sphere(std::vector<Vector3>{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
}

TEST_CASE("plane and circle in space") {
    const Vector3 normal = Vector3(1, 2e-5, -1.3e-4).normalized();
    const Vector3 center(-75, 3, -110);
    const Vector3 u = normal.unitOrthogonal(), v = normal.cross(u);
    std::vector<Vector3> points;
    for (int i = 0; i < 121; ++i) {
        const double a = rad_from_deg(i - 30.0);
        points.push_back(center + 130.0 * (std::cos(a) * u + std::sin(a) * v));
    }
    const auto plane = fit_plane(points);
    REQUIRE(plane);
    CHECK((plane->normal - normal).norm() < 1e-13);
    const auto circle = fit_circle_3d(points);
    REQUIRE(circle);
    CHECK((circle->center_mm - center).norm() < 1e-10);
    CHECK(std::abs(circle->radius_mm - 130.0) < 1e-10);
    CHECK_FALSE(fit_plane(std::vector<Vector3>{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}));
}

TEST_CASE("three points that are not in a line are enough for a plane and its circle") {
    const std::vector<Vector3> points = {{3, 0, 2}, {0, 4, 2}, {0, 0, 2}};
    const auto plane = fit_plane(points);
    REQUIRE(plane);
    CHECK((plane->normal - Vector3::UnitZ()).norm() < 1e-12);
    CHECK(plane->rms_mm < 1e-12);
    const auto circle = fit_circle_3d(points);
    REQUIRE(circle);
    CHECK((circle->center_mm - Vector3(1.5, 2, 2)).norm() < 1e-12);
    CHECK(circle->radius_mm == Approx(2.5));
    CHECK_FALSE(fit_plane(std::vector<Vector3>(4, Vector3(1, 2, 3))));
}

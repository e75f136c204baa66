// ISO 230-4 figures and the diagnosis table against circles whose errors are known.
#include "ballbar/test/circular_evaluation.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "ballbar/test/circular_diagnosis.h"
#include "base/random.h"
#include "base/units.h"

using namespace trunnion;

namespace {

/// Displacement of the tool in the plane for a sample at angle, direction of travel +-1.
using Displacement = std::function<Vector2(double angle, double ccw)>;

constexpr double radius = 100.0, feed_mm_s = 1000.0 / 60.0;
const Vector2 center(30.0, -12.0);

records::ReadingTable circles(const Displacement& displacement, double noise_mm = 0.0,
                              double arc_deg = 360, const char* plane = "xy", bool both = true) {
    records::ReadingTable table;
    table.axes = {Axis::X, Axis::Y, Axis::Z};
    SeededNoise noise(4);
    const ballbar::test::BallbarTestKind kind = ballbar::test::parse_ballbar_test(plane)->kind;
    const auto [u, v] = ballbar::test::axes_of_plane(kind);
    for (const double ccw : {1.0, -1.0}) {
        if (ccw < 0 && !both) break;
        const int count = 1440;
        for (int i = 0; i <= count; ++i) {
            const double turned = rad_from_deg(arc_deg) * i / count;
            const double a = 0.37 + (ccw > 0 ? turned : rad_from_deg(arc_deg) - turned);
            records::Reading row;
            row.index = static_cast<int>(table.rows.size());
            row.time_s = 1000.0 * (ccw < 0) + turned * radius / feed_mm_s;
            row.test = std::string(plane) + (ccw > 0 ? "_ccw_1000" : "_cw_1000");
            row.device = records::Device::ballbar;
            row.feed_mm_min = 1000.0;
            const Vector2 arm = radius * Vector2(std::cos(a), std::sin(a));
            row.commanded[u] = center.x() + arm.x();
            row.commanded[v] = center.y() + arm.y();
            row.value_mm = (arm + displacement(a, ccw)).norm() - radius + noise_mm * noise.normal();
            table.rows.push_back(row);
        }
    }
    return table;
}

ballbar::test::CircularTest one(const records::ReadingTable& table) {
    const auto tests = ballbar::test::circular_tests(table, radius);
    REQUIRE(tests.size() == 1);
    return tests.front();
}

const ballbar::test::CircularCause& cause(const ballbar::test::CircularDiagnosis& diagnosis,
                                          const std::string& name) {
    for (const ballbar::test::CircularCause& c : diagnosis.causes)
        if (c.name == name) return c;
    FAIL("no line " + name);
    return diagnosis.causes.front();
}

double sign(double v) {
    return v > 0 ? 1.0 : -1.0;
}

}  // namespace

TEST_CASE("a perfect circle off its centre has no figures but the mean radius") {
    const auto test = one(circles([](double, double) { return Vector2(0.05, -0.03); }));
    const auto figures = ballbar::test::circular_figures(test);
    CHECK(figures.bidirectional);
    CHECK(figures.circularity_ccw_um < 1e-6);
    CHECK(figures.bidirectional_circularity_um < 1e-6);
    CHECK(std::abs(figures.mean_radial_deviation_um) < 1e-6);
    CHECK(figures.hysteresis_um < 1e-6);
}

TEST_CASE("mean radial deviation and radial deviation") {
    const auto figures = ballbar::test::circular_figures(one(circles(
        [](double a, double) { return Vector2(0.004 * std::cos(a), 0.004 * std::sin(a)); })));
    CHECK(figures.mean_radial_deviation_um == Approx(4.0).epsilon(1e-6));
    CHECK(figures.radial_deviation_max_um == Approx(4.0).epsilon(1e-6));
    CHECK(figures.circularity_cw_um < 1e-6);
}

TEST_CASE("squareness gives an oval of its closed form") {
    const double angle = 40e-6;
    const auto test =
        one(circles([&](double a, double) { return Vector2(-angle * radius * std::sin(a), 0); }));
    const auto figures = ballbar::test::circular_figures(test);
    // Radius -angle R sin cos: from -angle R / 2 to + angle R / 2; hysteresis none.
    CHECK(figures.circularity_ccw_um == Approx(4.0).epsilon(1e-3));
    CHECK(figures.bidirectional_circularity_um == Approx(4.0).epsilon(1e-3));
    CHECK(figures.hysteresis_um < 1e-3);
    const auto diagnosis = ballbar::test::diagnose_circle(test);
    const auto& found = cause(diagnosis, "squareness XY");
    CHECK(found.value == Approx(40.0).epsilon(1e-3));
    CHECK(found.rank == 1);
    CHECK(found.share > 0.95);
    CHECK(found.share_um == Approx(4.0).epsilon(1e-3));
}

TEST_CASE("backlash is a step at the quadrants and the hysteresis") {
    const double gap = 0.006;
    const auto test = one(circles(
        [&](double a, double ccw) { return Vector2(0.5 * gap * sign(-ccw * std::sin(a)), 0); }));
    const auto figures = ballbar::test::circular_figures(test);
    // The two directions differ by gap |cos| everywhere; the common centre stays.
    CHECK(figures.hysteresis_um == Approx(6.0).epsilon(0.01));
    const auto diagnosis = ballbar::test::diagnose_circle(test);
    CHECK(cause(diagnosis, "backlash X").value == Approx(6.0).epsilon(0.01));
    CHECK(cause(diagnosis, "backlash X").rank == 1);
    CHECK(std::abs(cause(diagnosis, "backlash Y").value) < 0.02);
}

TEST_CASE("servo mismatch is told from squareness by running both ways") {
    const double tau_s = 0.3e-3;  // X lags Y
    const auto lag = [&](double a, double ccw) {
        return Vector2(tau_s * ccw * feed_mm_s * std::sin(a), 0);  // -tau * velocity of X
    };
    const auto both = ballbar::test::diagnose_circle(one(circles(lag)));
    CHECK(cause(both, "servo mismatch X-Y").value == Approx(0.3).epsilon(0.01));
    CHECK(std::abs(cause(both, "squareness XY").value) < 0.1);
    const auto single = ballbar::test::diagnose_circle(one(circles(lag, 0, 360, "xy", false)));
    REQUIRE_FALSE(single.not_separable.empty());
    CHECK(single.not_separable.front() == "servo mismatch X-Y");
}

TEST_CASE("scale mismatch, straightness, spikes and ripple together in noise") {
    const auto test = one(circles(
        [](double a, double ccw) {
            const double x = radius * std::cos(a), y = radius * std::sin(a);
            const double scale_x = 30e-6, bow_y = 0.005;
            const double travel_y = sign(ccw * std::cos(a));
            const double turned = radius * (1.0 - std::abs(std::sin(a)));  // Y turned at +-R
            // Before its first reversal in the pass nothing is known of Y's last one: the spike
            // still acts, as it does on a machine.
            return Vector2(
                scale_x * x + bow_y * y * y / (radius * radius) +
                    0.0015 * std::cos(2 * pi * (x + center.x()) / 10.0),
                -0.008 * travel_y * std::exp(-turned / 1.2) * (travel_y * y < 0.0 ? 1.0 : 0.0));
        },
        0.0002));
    const auto diagnosis = ballbar::test::diagnose_circle(test);
    const auto& scale = cause(diagnosis, "scale mismatch X-Y");
    CAPTURE(scale.value, scale.sigma);
    CHECK(scale.sigma < 0.4);
    CHECK(std::abs(scale.value - 30.0) < 3.0 * scale.sigma);
    CHECK(cause(diagnosis, "straightness Y").value == Approx(5.0).epsilon(0.05));
    CHECK(cause(diagnosis, "reversal spike Y").value == Approx(8.0).epsilon(0.1));
    CHECK(cause(diagnosis, "cyclic error X").value == Approx(1.5).epsilon(0.05));
    CHECK(cause(diagnosis, "cyclic error X").note == "pitch 10.00 mm");
    CHECK(cause(diagnosis, "reversal spike Y").rank == 1);
    double sum = 0.0;
    for (const ballbar::test::CircularCause& c : diagnosis.causes) {
        sum += c.share;
        CHECK(c.sigma > 0.0);
    }
    CHECK(sum == Approx(1.0));
    CHECK(diagnosis.residual_um < 0.3);
}

TEST_CASE("in pure noise nothing is significant") {
    const auto diagnosis = ballbar::test::diagnose_circle(
        one(circles([](double, double) { return Vector2(0.02, 0.01); }, 0.0005)));
    for (const ballbar::test::CircularCause& c : diagnosis.causes) {
        CAPTURE(c.name, c.value, c.sigma);
        CHECK(std::abs(c.value) < 4.0 * c.sigma);
        CHECK(c.name.find("spike") == std::string::npos);
        CHECK(c.name.find("cyclic") == std::string::npos);
    }
    CHECK(diagnosis.residual_um == Approx(0.5 * std::sqrt(720.0 / 1441.0)).epsilon(0.1));
}

TEST_CASE("a partial arc in YZ is evaluated on what was run") {
    const auto test = one(circles(
        [](double a, double) { return Vector2(-50e-6 * radius * std::sin(a) + 0.02, 0.01); }, 1e-4,
        220, "yz"));
    CHECK(deg_from_rad(test.arc_rad) == Approx(220).epsilon(0.01));
    const auto diagnosis = ballbar::test::diagnose_circle(test);
    const auto& found = cause(diagnosis, "squareness YZ");
    CHECK(std::abs(found.value - 50.0) < 5.0 * found.sigma);
    CHECK(found.significant);
}

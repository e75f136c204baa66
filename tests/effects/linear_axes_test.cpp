// Effects of the linear axes and the drives against their laws.
#include <catch2/catch.hpp>

#include "tests/effects/bc_physics.h"

namespace trunnion {

TEST_CASE("linear axes: scale, straightness, angles, ripple, squareness move the tip",
          "[effects]") {
    const Physics physics;
    for (int d = 0; d < 3; ++d) {
        const std::string name(1, "XYZ"[d]);
        INFO(name);
        const Vector3 along = Vector3::Unit(d), side = Vector3::Unit((d + 1) % 3);
        const std::string lateral(1, "XYZ"[(d + 1) % 3]);
        CHECK(physics.miss(
                  name + ".scale: scale_ppm=20, bow2_mm=0.001, bow3_mm=0.0005", [&](const Seen& s) {
                      const double u = s.at(d) / 200.0;
                      return tip((20e-6 * s.at(d) + 1e-3 * u * u + 5e-4 * u * u * u) * along);
                  }) < 1e-6);
        CHECK(physics.miss(name + ".straightness: E" + lateral + name + "_p1_mm=0.004, E" +
                               lateral + name + "_p2_mm=0.005, E" + lateral + name + "_p4_mm=0.001",
                           [&](const Seen& s) {
                               const double u = s.at(d) / 200.0;
                               return tip((4e-3 * u + 5e-3 * u * u + 1e-3 * std::pow(u, 4)) * side);
                           }) < 1e-6);
        CHECK(physics.miss(name + ".angular: EA" + name + "_p1_rad=3e-5, EB" + name +
                               "_p2_rad=2e-5, EC" + name + "_p1_rad=1e-5",
                           [&](const Seen& s) {
                               const double u = s.at(d) / 200.0;
                               Wrong w;
                               w.tool = {3e-5 * u, 2e-5 * u * u, 1e-5 * u};
                               Vector3 carried = s.at;  // slides further along b X Y Z t
                               carried.head(d + 1).setZero();
                               w.tip = w.tool.cross(carried);
                               return w;
                           }) < 1e-4);
        CHECK(physics.miss(name + ".cyclic: cos_mm=2um, sin_mm=1um, period_mm=12",
                           [&](const Seen& s) {
                               const double a = 2.0 * pi * s.at(d) / 12.0;
                               return tip((2e-3 * std::cos(a) + 1e-3 * std::sin(a)) * along);
                           }) < 1e-6);
    }
    const double lean = std::sin(40e-6), shorter = std::cos(40e-6) - 1.0;
    CHECK(physics.miss("XY.squareness=40urad", [&](const Seen& s) {
        return tip({-lean * s.at.y(), shorter * s.at.y(), 0.0});  // Y turned about Z leans to -X
    }) < 1e-6);
    CHECK(physics.miss("YZ.squareness=40urad", [&](const Seen& s) {
        return tip({0.0, -lean * s.at.z(), shorter * s.at.z()});  // Z turned about X leans to -Y
    }) < 1e-6);
    CHECK(physics.miss("ZX.squareness=40urad", [&](const Seen& s) {
        return tip({lean * s.at.z(), 0.0, shorter * s.at.z()});  // Z turned about Y leans to +X
    }) < 1e-6);
}

TEST_CASE("drives: backlash, lateral play, reversal, lag", "[effects]") {
    const Physics physics;
    for (int d = 0; d < 3; ++d) {
        const std::string name(1, "XYZ"[d]);
        INFO(name);
        const Vector3 along = Vector3::Unit(d), side = Vector3::Unit((d + 1) % 3);
        const auto half = [&](const Seen& s) { return tip(3e-3 * s.travel(d) * along); };
        CHECK(physics.miss(name + ".backlash=6um", half, probing) < 1e-5);
        CHECK(physics.miss(name + ".backlash=6um", half, away_from_turns) < 1e-5);
        CHECK(physics.miss(
                  name + ".lateral_play: play_" + "xyz"[(d + 1) % 3] + std::string("_mm=4um"),
                  [&](const Seen& s) { return tip(2e-3 * s.travel(d) * side); },
                  away_from_turns) < 1e-5);
    }
    CHECK(physics.miss(
              "X.reversal_spike: height_mm=6um, decay_mm=3, law=1",
              [](const Seen& s) {
                  const double h = s.since_x > 1e6 ? 0.0 : 6e-3 * std::exp(-s.since_x / 3.0);
                  return tip({-h * s.travel.x(), 0.0, 0.0});
              },
              [](const Seen& s) {
                  return away_from_turns(s) && s.row->test.rfind("plane0", 0) == 0;
              }) < 0.02);
    CHECK(physics.miss(
              "servo.mismatch: tau_x_s=0.5ms, tau_y_s=-0.2ms, tau_z_s=0.1ms",
              [](const Seen& s) {
                  return tip(-Vector3(0.5e-3, -0.2e-3, 0.1e-3).cwiseProduct(s.velocity));
              },
              moving) < 1e-3);
    CHECK(physics.miss(
              "servo.contour: lag2_s2=1e-4",
              [](const Seen& s) { return tip(1e-4 * s.acceleration); }, moving) < 2e-3);
    CHECK(physics.miss(
              "servo.contour: lag2_y_s2=1e-4",
              [](const Seen& s) {
                  return tip({0.0, 1e-4 * s.acceleration.y(), 0.0});
              },
              moving) < 2e-3);
    CHECK(physics.miss(
              "servo.mismatch: lag3_x_s3=1e-4",
              [](const Seen& s) {  // the jerk of a circle is - (speed / radius)^2 velocity
                  const double turn2 = s.velocity.squaredNorm() / (bar_mm * bar_mm);
                  return tip({1e-4 * turn2 * s.velocity.x(), 0.0, 0.0});
              },
              moving) < 0.02);
    CHECK(physics.miss(
              "control.chord: fraction=1, block_mm=20",
              [](const Seen& s) {
                  const double on = std::fmod(s.path, 20.0);
                  const Vector3 in = s.acceleration.normalized();
                  return tip(on * (20.0 - on) / (2.0 * bar_mm) * in);
              },
              moving) < 0.02);
}

}  // namespace trunnion

// Effects of heat, load, devices and wrong stores against their laws.
#include <catch2/catch.hpp>

#include "tests/effects/bc_physics.h"

namespace trunnion {

TEST_CASE("time, temperature, load, clamps", "[effects]") {
    const Physics physics;
    CHECK(physics.miss("thermal.drift: d_mm=[0.01, -0.005, 0.02], tau_s=600", [](const Seen& s) {
        return tip((1.0 - std::exp(-s.row->time_s / 600.0)) * Vector3(0.01, -0.005, 0.02));
    }) < 1e-6);
    CHECK(physics.miss("thermal.expansion: growth_x_per_k=8e-6, growth_z_per_k=-5e-6",
                       [](const Seen& s) {
                           const double k = s.row->temperature_c - 20.0;
                           return tip(k * Vector3(8e-6 * s.at.x(), 0.0, -5e-6 * s.at.z()));
                       }) < 1e-6);
    CHECK(physics.miss("machine.expansion: stretch_ppm=25",
                       [](const Seen& s) { return tip(25e-6 * s.at); }) < 1e-6);
    CHECK(physics.miss("gravity.sag: twist_rad=30urad, sag_mm=4um", [](const Seen& s) {
        const double weight = 1.0 + s.row->load_kg / 100.0;
        Wrong w;
        w.b = 30e-6 * weight * std::sin(s.b);
        w.carrier.z() = -4e-3 * (weight * std::cos(s.b) * std::cos(s.b) - 1.0);
        return w;
    }) < 1e-3);
    CHECK(physics.miss("clamp.shift: shift_b_mm=[0.004, 0, -0.003], turn_c_rad=20urad",
                       [](const Seen& s) {
                           Wrong w;
                           if (s.row->clamped) w.carrier = {0.004, 0.0, -0.003}, w.c = 20e-6;
                           return w;
                       }) < 1e-3);
}

TEST_CASE("probe, bar and artefacts", "[effects]") {
    Physics physics;
    const auto touching = [](const Seen& s) { return s.row->device == records::Device::touch; };
    CHECK(physics.miss(
              "probe.radius: radius_mm=3um, delay_s=2ms",
              [](const Seen& s) {
                  Wrong w;
                  w.reading = -3e-3 + 2e-3 * s.row->feed_mm_min / 60.0;
                  return w;
              },
              touching) < 1e-6);
    CHECK(physics.miss(
              "probe.pretravel: cos3_mm=3um, sin2_mm=1um",
              [](const Seen& s) {
                  const Vector3& d = s.row->direction_M;
                  const double phi = std::atan2(d.y(), d.x()) - s.row->spindle_rad;
                  Wrong w;
                  w.reading = std::hypot(d.x(), d.y()) *
                              (3e-3 * std::cos(3 * phi) + 1e-3 * std::sin(2 * phi));
                  return w;
              },
              touching) < 1e-6);
    CHECK(physics.miss(
              "probe.runout: dx_mm=5um, dy_mm=-3um",
              [](const Seen& s) {
                  const double c = std::cos(s.row->spindle_rad);
                  const double n = std::sin(s.row->spindle_rad);
                  return tip({5e-3 * c + 3e-3 * n, 5e-3 * n - 3e-3 * c, 0.0});
              },
              probing) < 1e-6);
    CHECK(physics.miss(
              "tool.length=15um",
              [](const Seen&) {
                  return tip({0, 0, -15e-3});
              },
              probing) < 1e-6);
    CHECK(physics.miss(
              "ballbar.length=3um",
              [](const Seen&) {
                  Wrong w;
                  w.reading = 3e-3;
                  return w;
              },
              [](const Seen& s) { return s.row->device == records::Device::ballbar; }) < 1e-6);
    CHECK(physics.miss(
              "artefact.form: q1_mm=1um, q3_mm=0.5um, artefact=0",
              [](const Seen& s) {
                  // Outward normal where the stylus comes from, seen from the table.
                  const Vector3 n = about_z(about_y(-s.row->direction_M, -s.b), -s.c);
                  Wrong w;
                  w.reading =
                      -(1e-3 * (n.x() * n.x() - n.y() * n.y()) + 0.5e-3 * 2.0 * n.x() * n.z());
                  return w;
              },
              touching) < 1e-6);
    CHECK(physics.miss("artefact.moved: shift_mm=[0.01, 0, -0.005], artefact=1, time_s=250",
                       [](const Seen& s) {
                           Wrong w;
                           if (s.row->feature == "S2" && s.row->time_s >= 250.0)
                               w.work = {0.01, 0.0, -0.005};
                           return w;
                       }) < 1e-6);
    physics.setup.artefacts[1].free_center = false;
    CHECK(physics.miss("artefact.position: shift_S2_mm=[0.02, 0.01, 0]", [](const Seen& s) {
        Wrong w;
        if (s.row->feature == "S2") w.work = {0.02, 0.01, 0.0};
        return w;
    }) < 1e-6);
}

TEST_CASE("belief: wrong stores and rounded words", "[effects]") {
    const Physics physics;
    const auto turned = [](const Seen& s, const Vector3& v) {
        return about_y(about_z(v, s.c), s.b);
    };
    CHECK(physics.miss("pivot.g54: dg_mm=[10um, -20um, 30um]", [&](const Seen& s) {
        const Vector3 dg(0.01, -0.02, 0.03);
        const bool uses =
            s.row->mode == PositioningMode::dpp || s.row->mode == PositioningMode::rtdfo;
        return tip(uses ? Vector3(dg - turned(s, dg)) : Vector3(Vector3::Zero()));
    }) < 1e-6);
    CHECK(physics.miss(
              "pivot.p1970x: dp_mm=[10um, 20um, -10um], dd_mm=[20um, 0, 10um]", [&](const Seen& s) {
                  const Vector3 dp(0.01, 0.02, -0.01), dd(0.02, 0.0, 0.01), sum = dp + dd;
                  const bool uses =
                      s.row->mode == PositioningMode::rtcp || s.row->mode == PositioningMode::tw;
                  const Vector3 e = turned(s, sum) - sum - (about_y(dd, s.b) - dd);
                  return tip(uses ? Vector3(-e) : Vector3(Vector3::Zero()));
              }) < 1e-6);
    CHECK(physics.miss(
              "control.rounding: fraction=1, increment_deg=0.01, increment_mm=0.01",
              [](const Seen& s) {
                  const auto off = [](double v, double step) {
                      return std::round(v / step) * step - v;
                  };
                  const double degree = pi / 180.0;
                  Wrong w = tip({off(s.at.x(), 0.01), off(s.at.y(), 0.01), off(s.at.z(), 0.01)});
                  w.b = off(s.b, 0.01 * degree);
                  w.c = off(s.c, 0.01 * degree);
                  return w;
              }) < 1e-4);
}

}  // namespace trunnion

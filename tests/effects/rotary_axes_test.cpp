// Effects of the rotary axes against their laws.
#include <catch2/catch.hpp>

#include "tests/effects/bc_physics.h"

namespace trunnion {

TEST_CASE("the own forward model and the emulator read the same without effects", "[effects]") {
    const Physics physics;
    const records::ReadingTable read = emulator::predicted(physics.setup, physics.table, {});
    for (std::size_t i = 0; i < read.rows.size(); ++i)
        if (read.rows[i].value_mm)
            REQUIRE(*read.rows[i].value_mm ==
                    Approx(reading(physics.seen[i], nothing_wrong)).margin(1e-9));
}

TEST_CASE("rotary axes: zero, positioning, ripple, backlash turn the work about the axis",
          "[effects]") {
    const Physics physics;
    const auto angle = [](char axis, const std::function<double(double q)>& law) {
        return [=](const Seen& s) {
            Wrong w;
            (axis == 'B' ? w.b : w.c) = law(axis == 'B' ? s.b : s.c);
            return w;
        };
    };
    for (const char axis : {'B', 'C'}) {
        const std::string name(1, axis);
        INFO(name);
        CHECK(physics.miss(name + ".zero=50urad", angle(axis, [](double) { return 50e-6; })) <
              1e-6);
        CHECK(physics.miss(name + ".positioning: cos1_rad=3e-5, sin2_rad=-2e-5",
                           angle(axis, [](double q) {
                               return 3e-5 * std::cos(q) - 2e-5 * std::sin(2.0 * q);
                           })) < 1e-6);
        CHECK(physics.miss(name + ".cyclic: cos_rad=2e-5, sin_rad=1e-5, periods_per_turn=72",
                           angle(axis, [](double q) {
                               return 2e-5 * std::cos(72 * q) + 1e-5 * std::sin(72 * q);
                           })) < 1e-6);
        CHECK(physics.miss(
                  name + ".backlash=12arcsec",
                  [&](const Seen& s) {
                      Wrong w;
                      const double half = 0.5 * 12.0 / 3600.0 * pi / 180.0;
                      w.b = axis == 'B' ? half * s.travel_b : 0.0;
                      w.c = axis == 'C' ? half * s.travel_c : 0.0;
                      return w;
                  },
                  probing) < 1e-6);
    }
    CHECK(physics.miss("B.positioning: slope_rad_per_rad=2e-5",
                       angle('B', [](double q) { return 2e-5 * q; })) < 1e-6);
}

TEST_CASE("rotary axes: radial, axial and tilt motion, and location errors", "[effects]") {
    const Physics physics;
    const auto wave = [](double q) { return 3e-3 * std::cos(2.0 * q) + 1e-3 * std::sin(q); };
    CHECK(physics.miss("B.radial: EXB_cos2_mm=0.003, EXB_sin1_mm=0.001, EZB_cos1_mm=0.002",
                       [&](const Seen& s) {
                           Wrong w;
                           w.carrier = {wave(s.b), 0.0, 2e-3 * std::cos(s.b)};
                           return w;
                       }) < 1e-6);
    CHECK(physics.miss("C.radial: EXC_cos2_mm=0.003, EXC_sin1_mm=0.001, EYC_cos1_mm=0.002",
                       [&](const Seen& s) {
                           Wrong w;
                           w.plate = {wave(s.c), 2e-3 * std::cos(s.c), 0.0};
                           return w;
                       }) < 1e-6);
    CHECK(physics.miss("B.axial: EYB_cos2_mm=0.003, EYB_sin1_mm=0.001", [&](const Seen& s) {
        Wrong w;
        w.carrier.y() = wave(s.b);
        return w;
    }) < 1e-6);
    CHECK(physics.miss("C.axial: EZC_cos2_mm=0.003, EZC_sin1_mm=0.001", [&](const Seen& s) {
        Wrong w;
        w.plate.z() = wave(s.c);
        return w;
    }) < 1e-6);
    CHECK(physics.miss("B.tilt: EAB_cos2_rad=3e-5, ECB_sin1_rad=2e-5", [](const Seen& s) {
        Wrong w;
        w.carrier_tilt = {3e-5 * std::cos(2.0 * s.b), 0.0, 2e-5 * std::sin(s.b)};
        return w;
    }) < 1e-4);
    CHECK(physics.miss("C.tilt: EAC_cos2_rad=3e-5, EBC_sin1_rad=2e-5", [](const Seen& s) {
        Wrong w;
        w.plate_tilt = {3e-5 * std::cos(2.0 * s.c), 2e-5 * std::sin(s.c), 0.0};
        return w;
    }) < 1e-4);
    CHECK(physics.miss("location: EX0B_mm=10um, EC0B_rad=20urad, EY0C_mm=-8um, EA0C_rad=30urad",
                       [](const Seen&) {
                           Wrong w;
                           w.carrier = {10e-3, 0.0, 0.0};
                           w.carrier_tilt = {0.0, 0.0, 20e-6};
                           w.plate = {0.0, -8e-3, 0.0};
                           w.plate_tilt = {30e-6, 0.0, 0.0};
                           return w;
                       }) < 1e-4);
}

}  // namespace trunnion

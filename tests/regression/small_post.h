// A small post for tests: parts with seeded sizes, written the way posts write.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "base/random.h"
#include "base/units.h"
#include "geometry/pose.h"

namespace trunnion::testing {

/// The sizes of one part, rounded to 0.001 mm.
struct SmallPart {
    double depth, side, radius, hole_x, hole_y, step, feed, speed, tilt_deg, turn_deg;
};

inline SmallPart small_part(std::uint64_t seed) {
    SeededNoise noise(seed);
    const auto between = [&noise](double low, double high) {
        const double part = static_cast<double>(noise.bits() % 100000) / 1e5;
        return std::round((low + part * (high - low)) * 1e3) / 1e3;
    };
    return {between(0.5, 3.0),
            between(20.0, 40.0),
            between(5.0, 12.0),
            between(5.0, 15.0),
            between(5.0, 15.0),
            between(8.0, 14.0),
            std::round(between(400.0, 900.0)),
            std::round(between(3000.0, 9000.0)),
            between(10.0, 30.0),
            between(20.0, 60.0)};
}

/// A contour with cutter compensation, holes with two cycles, an inverse time section, a tilted
/// plane. Every line ends with a number that is unique in its neighbourhood.
inline std::string small_post(const SmallPart& p) {
    const double x = p.side, r = p.radius;
    std::string out = "%\nO1000 (PART)\nG21 G90 G17 G94 G40 G49 G80\nG10 L2 P2 X5. Y6. Z1.\n";
    out += "G54\nT1 M6\n";
    out += fmt::format("S{:.0f} M3\nG0 X{:.3f} Y-20.\nG43 H1 Z160. M8\nZ142.\n", p.speed, x + 20.0);
    out += fmt::format("G1 Z{:.3f} F300.\n", 140.0 - p.depth);
    out += fmt::format("G41 D1 X{:.3f} Y-10. F{:.0f}.\nY{:.3f}\n", x, p.feed, x);
    out += fmt::format("G3 X{:.3f} Y{:.3f} I-{:.3f} J0.\n", x - r, x + r, r);
    out += fmt::format("G1 X-{:.3f}\nG40 X-{:.3f} Y{:.3f}\n", x, x + 15.0, x + 20.0);
    out += "G0 Z160.\nM9\nM5\nT2 M6\n";
    out += fmt::format("S{:.0f} M3\nG55\nG0 X{:.3f} Y{:.3f}\nG43 H2 Z160. M8\n", 0.5 * p.speed,
                       p.hole_x, p.hole_y);
    out += fmt::format("G98 G82 X{:.3f} Y{:.3f} Z135. R145. P300 F120.\nX{:.3f}\nX{:.3f}\nG80\n",
                       p.hole_x, p.hole_y, p.hole_x + p.step, p.hole_x + 2.0 * p.step);
    out += fmt::format("G99 G83 X{:.3f} Y-5. Z130. R144. Q3. F90.\nX{:.3f}\nG80\n", p.hole_x,
                       p.hole_x + p.step);
    out += "G0 Z160.\nM9\nM5\nT3 M6\n";
    out += fmt::format("S{:.0f} M3\nG54\nG0 X0. Y0.\nG43 H3 Z160. M8\nG1 Z141. F500.\n",
                       0.8 * p.speed);
    out += fmt::format("G93\nX{:.3f} F40.\nY{:.3f} F40.\nX0. F40.\nG94\nG0 Z160.\n", x, r);
    out +=
        fmt::format("G49\nG68.2 X0. Y0. Z0. I{:.3f} J{:.3f} K0.\nG53.1\n", p.turn_deg, p.tilt_deg);
    out += fmt::format("G43 H3 Z170.\nG0 X5. Y5.\nZ150.\nG1 Z145. F250.\nX{:.3f} F{:.0f}.\n",
                       5.0 + p.step, p.feed);
    out += "Y15.\nG0 Z180.\nG49\nG69\nM9\nM5\nM30\n%\n";
    return out;
}

/// Five sections by the post's own kinematics: it works the turn of the BC table out with its own
/// pivot (mm, machine coordinates) and tool length, so that an error of them shows. `part` of the
/// angles is turned.
inline std::string own_kinematics_post(const Vector3& pivot_mm, double length_mm,
                                       double part = 1.0) {
    std::string out = "%\nO1001\nG21 G90 G17 G94 G40 G49\nG54\nT1 M6\nS5000 M3\n";
    const double angles[5][2] = {
        {0.0, 0.0}, {20.0, 0.0}, {20.0, 60.0}, {-15.0, 30.0}, {35.0, 110.0}};
    for (const auto& [whole_b, whole_c] : angles) {
        const double b = part * whole_b, c = part * whole_c;
        // ISO 841: a table axis turns against the tool.
        const Matrix3 turned = rotation_about(-Vector3::UnitY(), rad_from_deg(b)) *
                               rotation_about(-Vector3::UnitZ(), rad_from_deg(c));
        const auto at = [&](double x, double y, double z) -> Vector3 {
            const Vector3 p = turned * (Vector3(x, y, z) - pivot_mm) + pivot_mm;
            return p + Vector3(0.0, 0.0, length_mm);
        };
        const Vector3 over = at(10.0, 5.0, 60.0), in = at(10.0, 5.0, 20.0),
                      end = at(30.0, 5.0, 20.0), out_mm = at(30.0, 5.0, 60.0);
        out += fmt::format("G0 Z200.\nG0 B{:.3f} C{:.3f}\nX{:.4f} Y{:.4f}\nZ{:.4f}\n", b, c,
                           over.x(), over.y(), over.z());
        out += fmt::format("G1 X{:.4f} Y{:.4f} Z{:.4f} F300.\n", in.x(), in.y(), in.z());
        out += fmt::format("X{:.4f} Y{:.4f} Z{:.4f} F800.\n", end.x(), end.y(), end.z());
        out += fmt::format("G0 X{:.4f} Y{:.4f} Z{:.4f}\n", out_mm.x(), out_mm.y(), out_mm.z());
    }
    return out + "G0 Z200.\nM5\nM30\n%\n";
}

}  // namespace trunnion::testing

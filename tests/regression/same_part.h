// One part as four posts would write it, for a BC or an AC table. Own mathematics: rotations about
// the machine's axes by hand, nothing of the control's transforms.
#pragma once

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "base/units.h"
#include "geometry/pose.h"

namespace trunnion::testing {

enum class Post { dpp, tcp, plane, fixture };
constexpr std::array<const char*, 4> post_names{"own kinematics", "G43.4", "G68.2 G53.1", "G54.2"};

/// A table machine with crossing axes at `pivot`, and where the part's zero lies on the table.
struct PartOnTable {
    char tilt =
        'B';  ///< the tilting axis, B or A; C turns on it; + turns the table against the tool
    Vector3 pivot_mm{12.0, -7.0, 31.0};
    Vector3 zero_W_mm{45.0, -22.0, 58.0};
    Vector3 shift_mm = Vector3::Zero();  ///< of the last cut: a part that is not the same
    double turn_c_deg = 0.0;             ///< added to every C word: a wrong part, or a full turn

    /// Orientations as (tilt, C) of a BC machine; the AC machine has C 90 degrees on.
    static std::vector<std::pair<double, double>> orientations() {
        return {{0, 0}, {20, 45}, {-35, 160}, {90, -30}};
    }
    double c_deg(double c) const { return c + (tilt == 'A' ? 90.0 : 0.0); }

    Matrix3 table_rotation(double tilt_deg, double c) const {
        return rotation(tilt == 'B' ? Vector3::UnitY() : Vector3::UnitX(), tilt_deg, c_deg(c));
    }
    /// The cut's own axes, fixed to the part whatever the machine.
    static Matrix3 cut_axes(double tilt_deg, double c) {
        return rotation(Vector3::UnitY(), tilt_deg, c).transpose();
    }
    static Matrix3 rotation(const Vector3& tilt_axis, double tilt_deg, double c) {
        const auto turn = [](double deg, const Vector3& about) {
            return Eigen::AngleAxisd(-rad_from_deg(deg), about).toRotationMatrix();
        };
        return turn(tilt_deg, tilt_axis) * turn(c, Vector3::UnitZ());
    }

    /// The program of a post; the offsets it needs are set by G10 at its head.
    std::string program(Post post) const {
        const bool at_pivot = post == Post::dpp || post == Post::fixture;
        const Vector3 g54 = at_pivot ? pivot_mm : zero_W_mm;
        std::string text = "%\nO1\nG90 G21 G17 G94 G40\nG10 L2 P1" + xyz(g54) + "\n";
        if (post == Post::fixture)
            text += "G10 L21 P1" + xyz(zero_W_mm - pivot_mm) + fmt::format(" {}0. C0.\n", tilt);
        text += "G54\nT1 M6\nS500 M3\n";
        const auto all = orientations();
        for (const auto& o : all)
            text +=
                section(post, o.first, o.second, &o == &all.back() ? shift_mm : Vector3::Zero());
        return text + "M30\n%\n";
    }

  private:
    static std::string xyz(const Vector3& p) {
        return fmt::format(" X{:.6f} Y{:.6f} Z{:.6f}", p.x(), p.y(), p.z());
    }

    std::string section(Post post, double tilt_deg, double c, const Vector3& shift) const {
        const Matrix3 R = table_rotation(tilt_deg, c);
        const std::string turn =
            fmt::format(" {}{:.4f} C{:.4f}", tilt, tilt_deg, c_deg(c) + turn_c_deg);
        // The plane of the cut: x, y across the tool, z along it, through a point of the part.
        const Vector3 origin(8.0, 5.0, -3.0);
        const auto word = [&](double x, double y, double z) {
            const Vector3 p = origin + cut_axes(tilt_deg, c) * Vector3(x, y, z) + shift;
            if (post == Post::tcp) return p;
            if (post == Post::plane || post == Post::fixture) return Vector3(R * p);
            return Vector3(R * (zero_W_mm + p - pivot_mm));  // the tip seen from the pivot
        };
        std::string s = "G53 G0 Z300.\n";
        if (post == Post::tcp)
            s += fmt::format("G0 {}0. C0.\nG43.4 H1\nG0", tilt) + turn + xyz(word(0, 0, 40)) + "\n";
        else
            s += "G0" + turn + "\n";
        if (post == Post::plane)
            s += fmt::format("G68.2 X0. Y0. Z0. I{:.4f} J{:.4f} K{:.4f}\nG53.1\n",
                             tilt == 'B' ? c + 90.0 : c_deg(c), tilt_deg, tilt == 'B' ? -90. : 0.);
        if (post == Post::fixture) s += "G54.2 P1\n";
        if (post != Post::tcp) s += "G43 H1 G0" + xyz(word(0, 0, 40)) + "\n";
        s += "G0" + xyz(word(0, 0, 2)) + "\nG1 F300." + xyz(word(0, 0, -1)) + "\n";
        s += "F800." + xyz(word(20, 0, -1)) + "\n";
        s += half_circle(post, word);
        s += "G1" + xyz(word(0, 10, -1)) + "\nG0" + xyz(word(0, 10, 40)) + "\n";
        if (post == Post::fixture) s += "G54.2 P0\n";
        s += "G49\n";
        return post == Post::plane ? s + "G69\n" : s;
    }

    /// From (20, 0) round (20, 5) to (20, 10): an arc where XY lies in the cut's plane, else
    /// chords.
    template <typename Word>
    std::string half_circle(Post post, const Word& word) const {
        const Vector3 e = word(20, 10, -1), centre = word(20, 5, -1) - word(20, 0, -1);
        if (post != Post::tcp)
            return fmt::format("G3 X{:.6f} Y{:.6f} I{:.6f} J{:.6f}\n", e.x(), e.y(), centre.x(),
                               centre.y());
        std::string s;
        for (int k = 1; k <= 90; ++k) {
            const double angle = -pi / 2 + k * pi / 90;
            s += xyz(word(20 + 5 * std::cos(angle), 5 + 5 * std::sin(angle), -1)).substr(1) + "\n";
        }
        return s;
    }
};

}  // namespace trunnion::testing

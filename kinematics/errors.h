// Geometric errors of the physical machine after ISO 230-1 and ISO 230-7.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/axes.h"
#include "geometry/axis_names.h"
#include "geometry/pose.h"

namespace trunnion::kinematics {

/// EXX, EC0A, ...: letter of the direction (X Y Z: along; A B C: about), and the axis it belongs
/// to. `location` true: E?0? (position and orientation of the axis line); false: E?? (error
/// motion).
struct ErrorName {
    char direction = 'X';
    bool location = false;
    Axis axis = Axis::X;

    bool angular() const { return direction >= 'A' && direction <= 'C'; }
    friend bool operator==(const ErrorName&, const ErrorName&) = default;
};

/// "EX0C", "EA0J1"; nothing if it is none of an axis of `names`.
std::optional<ErrorName> parse_error_name(std::string_view text, const AxisNames& names = {});
std::string to_string(const ErrorName& name, const AxisNames& names = {});

/// EXS, EA0S, ...: an error of the spindle. ISO 230-7 has no ECS: that is the way it turns.
struct SpindleErrorName {
    std::size_t direction = 0;  ///< 0..4 = X Y Z A B
    bool location = false;

    bool angular() const { return direction >= 3; }
};

std::optional<SpindleErrorName> parse_spindle_error_name(std::string_view text);
std::string to_string(const SpindleErrorName& name);

/// An error as a function of its axis's position (mm or rad in, mm or rad out): a value, the sum of
/// constant + slope * q + harmonics + table.
struct ErrorCurve {
    struct Harmonic {
        double order =
            1.0;  ///< per turn of a rotary axis; per mm * 2 pi / `period_mm` for a linear one
        double cosine = 0.0;
        double sine = 0.0;
    };
    enum class Interpolation : unsigned char { linear, cubic };

    double constant = 0.0;
    double slope = 0.0;
    double period_mm = 0.0;  ///< of harmonics of a linear axis
    std::vector<Harmonic> harmonics;
    std::vector<double> at;  ///< table positions, rising
    std::vector<double> value;
    Interpolation interpolation = Interpolation::linear;

    bool is_zero() const;
    double operator()(double q) const;  ///< held constant beyond the table's ends
    double derivative(double q) const;  ///< d error / d q
};

/// All errors of one axis. Index 0..5 = X Y Z (mm), A B C (rad), along and about + axes of M.
struct AxisErrors {
    std::array<double, 6> location{};
    std::array<ErrorCurve, 6> motion{};
};

struct GeometricErrors {
    std::array<AxisErrors, axis_count> axis{};
    /// Of the spindle, along and about + axes of S: `location` of the mean line of its axis,
    /// `motion` by its angle (constants and harmonics).
    AxisErrors spindle;

    double& location(const ErrorName& name);
    double location(const ErrorName& name) const;
    ErrorCurve& motion(const ErrorName& name);
};

}  // namespace trunnion::kinematics

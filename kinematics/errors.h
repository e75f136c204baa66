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

/// Name of a geometric error, e.g. EXX or EC0A: direction (X Y Z: translation; A B C: rotation) and
/// the axis that it belongs to. `location` true: E?0?, position or orientation error of the axis
/// line. False: E??, error motion.
struct ErrorName {
    char direction = 'X';
    bool location = false;
    Axis axis = Axis::X;

    bool angular() const { return direction >= 'A' && direction <= 'C'; }
    friend bool operator==(const ErrorName&, const ErrorName&) = default;
};

/// Parses "EX0C" or "EA0J1". Empty when `text` is not an error name of an axis in `names`.
std::optional<ErrorName> parse_error_name(std::string_view text, const AxisNames& names = {});
std::string to_string(const ErrorName& name, const AxisNames& names = {});

/// Name of a spindle error: EXS, EA0S, ... ISO 230-7 has no ECS, because the spindle turns about C.
struct SpindleErrorName {
    std::size_t direction = 0;  ///< 0..4 = X Y Z A B
    bool location = false;

    bool angular() const { return direction >= 3; }
};

std::optional<SpindleErrorName> parse_spindle_error_name(std::string_view text);
std::string to_string(const SpindleErrorName& name);

/// Error as a function of the position of its axis (input mm or rad, value mm or rad): constant +
/// slope * q + harmonics + table.
struct ErrorCurve {
    struct Harmonic {
        double order = 1.0;  ///< rotary axis: cycles a turn; linear axis: cycles in `period_mm`
        double cosine = 0.0;
        double sine = 0.0;
    };
    enum class Interpolation : unsigned char {
        linear,
        cubic,
        none  ///< the error is known at the positions alone, and 0 elsewhere
    };

    double constant = 0.0;
    double slope = 0.0;
    double period_mm = 0.0;  ///< period of the harmonics of a linear axis
    std::vector<Harmonic> harmonics;
    std::vector<double> at;  ///< table positions, strictly increasing
    std::vector<double> value;
    Interpolation interpolation = Interpolation::linear;

    bool is_zero() const;
    /// Beyond the ends of the table its contribution is constant. Without interpolation the error
    /// belongs to the places that a program commands: `commanded` meets one within a hundredth of
    /// its distance to the nearest other one, wherever other errors move the axis to (`q`).
    double operator()(double q, double commanded) const;
    double operator()(double q) const { return (*this)(q, q); }
    double derivative(double q) const;  ///< d error / d q, 0 from the table beyond its ends
};

/// "linear", "cubic", "none"
std::string_view to_string(ErrorCurve::Interpolation interpolation);
std::optional<ErrorCurve::Interpolation> parse_interpolation(std::string_view text);

/// All errors of one axis, along and about the + axes of M: index 0..5 = X Y Z (mm), A B C (rad).
struct AxisErrors {
    std::array<double, 6> location{};
    std::array<ErrorCurve, 6> motion{};
};

struct GeometricErrors {
    std::array<AxisErrors, axis_count> axis{};
    /// Spindle errors along and about the + axes of S. `location`: mean line of the spindle axis;
    /// `motion`: function of the spindle angle (constants and harmonics).
    AxisErrors spindle;

    double& location(const ErrorName& name);
    double location(const ErrorName& name) const;
    ErrorCurve& motion(const ErrorName& name);
};

}  // namespace trunnion::kinematics

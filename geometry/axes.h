// Machine axes by letter, and their positions.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

namespace trunnion::inline geometry {

/// The axis letters of ISO 841 that a setup file or an NC word can name.
enum class Axis : unsigned char { X, Y, Z, A, B, C, U, V, W };

constexpr std::size_t axis_count = 9;
constexpr std::array<Axis, axis_count> all_axes{Axis::X, Axis::Y, Axis::Z, Axis::A, Axis::B,
                                                Axis::C, Axis::U, Axis::V, Axis::W};

constexpr std::size_t index_of(Axis axis) {
    return static_cast<std::size_t>(axis);
}
constexpr char letter_of(Axis axis) {
    return "XYZABCUVW"[index_of(axis)];
}
constexpr bool is_rotary(Axis axis) {
    return axis == Axis::A || axis == Axis::B || axis == Axis::C;
}

/// The axis of an upper-case letter; empty for any other character.
constexpr std::optional<Axis> axis_of(char letter) {
    for (const Axis axis : all_axes)
        if (letter_of(axis) == letter) return axis;
    return std::nullopt;
}

/// One scalar for each axis letter: mm for linear axes, rad for rotary axes. Letters that a machine
/// does not have stay 0. Used as a position, it is the commanded machine coordinate with the sign
/// of the NC word, before `direction` of the setup file converts it into a motion of a body.
struct AxisPositions {
    std::array<double, axis_count> value{};

    double& operator[](Axis axis) { return value[index_of(axis)]; }
    double operator[](Axis axis) const { return value[index_of(axis)]; }
    friend bool operator==(const AxisPositions&, const AxisPositions&) = default;
};

/// Side from which each axis arrived, i.e. the sign of its last move: +1, -1, or 0 when unknown.
using AxisSides = std::array<signed char, axis_count>;

/// The believed positioning function under which a motion was commanded: column `mode` of readings.
enum class PositioningMode : unsigned char { none, dpp, rtdfo, rtcp, tw };

/// Time constant of the drive of each axis, s; 0: none is known.
using TimeConstants = std::array<double, axis_count>;

/// Axis positions with everything that an effect may depend on.
struct AxisSample {
    AxisPositions position;      ///< commanded machine coordinates, mm and rad
    AxisPositions velocity;      ///< mm/s and rad/s, 0 for an axis at rest
    AxisPositions acceleration;  ///< mm/s^2 and rad/s^2, commanded
    AxisPositions jerk;          ///< mm/s^3 and rad/s^3, commanded
    /// What the time constants of the drives add to velocity, acceleration and jerk
    /// (records/smoothed_motion.h); 0 without them.
    AxisPositions smooth_velocity, smooth_acceleration, smooth_jerk;
    AxisSides travel{};  ///< side from which each axis arrived; 0: at a reversal, or unknown
    std::array<bool, axis_count> side_unknown{};      ///< the side is not known; `travel` is
                                                      ///< assumed
    std::array<double, axis_count> since_reversal{};  ///< mm or rad travelled since the last
                                                      ///< reversal
    /// The axis started its test at a reversal point and has not reversed since. No row tells
    /// whether it arrived there from the other side (a run-up); since_reversal assumes that it did.
    std::array<bool, axis_count> run_up_unknown{};
    double path_mm = 0.0;  ///< travelled by the linear axes since the test began
    double time_s = 0.0;
    double feed_mm_min = 0.0;
    double spindle_rad = 0.0;
    bool spindle_turns = false;  ///< at speed: only values averaged over a full turn count
    double temperature_c = 20.0;
    double load_kg = 0.0;
    bool clamped = false;
    PositioningMode mode = PositioningMode::none;
};

}  // namespace trunnion::inline geometry

// The serial chain of a machine in the notation of ISO 10791-6, e.g. "w C B b X Y Z t".
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/axes.h"
#include "geometry/axis_names.h"
#include "geometry/pose.h"

namespace trunnion::kinematics {

/// One axis as the setup file describes it.
struct AxisGeometry {
    Axis axis = Axis::X;     ///< its slot in positions and errors
    std::string name = "X";  ///< its name in the chain
    bool rotary = false;
    Vector3 direction =
        Vector3::UnitX();  ///< unit vector in M, all axes at zero: motion of the carried body for a
                           ///< + command (table axes move against the tool)
    Vector3 point_mm = Vector3::Zero();  ///< rotary only: a point on the axis line, in M, all axes
                                         ///< at zero
    std::optional<double> min, max;      ///< travel limits, mm or rad
    std::optional<double> max_speed;     ///< mm/s or rad/s
    std::optional<double> max_acceleration;  ///< mm/s^2 or rad/s^2
};

/// The axes between bed and workpiece, and between bed and tool. Each list starts at the bed: "w C
/// B b X Y Z t" has work = {B, C} and tool = {X, Y, Z}.
struct Chain {
    std::vector<AxisGeometry> work;
    std::vector<AxisGeometry> tool;

    const AxisGeometry* find(Axis axis) const;
    /// All axes in the order of their slots: X Y Z A B C U V W, other names in chain order.
    std::vector<AxisGeometry> axes() const;
    AxisNames names() const;
};

/// True when the axis has an ISO 841 letter, so that an NC word can address it.
bool is_letter(const AxisGeometry& axis);

/// Parses the axis names. Directions and points keep their defaults. A, B and C are rotary; axes
/// with other names are linear until the setup file says otherwise. A name is a letter followed by
/// letters and digits; a chain has at most nine axes. Throws InputError without a position (the
/// setup reader adds it) when `text` is not "w AXES b AXES t" or when a name occurs twice. Names
/// are compared without case.
Chain parse_chain(std::string_view text);

}  // namespace trunnion::kinematics

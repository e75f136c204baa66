// The serial chain of a machine as ISO 10791-6 writes it, e.g. "w C B b X Y Z t".
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
    std::string name = "X";  ///< as the chain calls it
    bool rotary = false;
    Vector3 direction =
        Vector3::UnitX();  ///< in M, all axes at zero, unit: what a + command does to
                           ///< the carried body (table axes turn against the tool)
    Vector3 point_mm =
        Vector3::Zero();              ///< rotary: a point of the axis line, in M, all axes at zero
    std::optional<double> min, max;   ///< travel limits, mm or rad
    std::optional<double> max_speed;  ///< mm/s or rad/s
    std::optional<double> max_acceleration;  ///< mm/s^2 or rad/s^2
};

/// Axes between the bed and the workpiece, and between the bed and the tool, each from the bed
/// outwards: "w C B b X Y Z t" has work = {B, C} and tool = {X, Y, Z}.
struct Chain {
    std::vector<AxisGeometry> work;
    std::vector<AxisGeometry> tool;

    const AxisGeometry* find(Axis axis) const;
    /// All axes in the order of their slots: X Y Z A B C U V W, other names in chain order.
    std::vector<AxisGeometry> axes() const;
    AxisNames names() const;
};

/// What an NC word addresses: an axis called by a letter of ISO 841.
bool is_letter(const AxisGeometry& axis);

/// Names only: directions and points at their defaults, kinds by letter (A B C turn; other names do
/// not until the setup says so). A name is a letter and then letters and digits, at most nine axes.
/// Throws InputError without a place when `text` is not w AXES b AXES t with each name once,
/// whatever its case; the setup reader adds the place.
Chain parse_chain(std::string_view text);

}  // namespace trunnion::kinematics

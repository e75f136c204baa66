// Interpretation of a column of a log or point list by its name: axis, commanded or actual, speed.
#pragma once

#include <optional>
#include <string>

#include "geometry/axis_names.h"

namespace trunnion::imports {

enum class Role : unsigned char { none, commanded, actual, error, following_error };
enum class Rate : unsigned char { position, velocity, acceleration };

struct ColumnRole {
    std::string axis;  ///< letter, upper case, or the name of a machine axis: "J1"
    Role role = Role::none;
    Rate rate = Rate::position;
    bool machine = false;  ///< "machine x", "x axis": a position of the axis, not of a point
};

/// "X1_CommandPosition", "Ist X", "x_nom", "B axis velocity", "joint_3" of a machine with such axis
/// names. Empty for a name with a word of another meaning (a current, a temperature), or without an
/// axis.
std::optional<ColumnRole> role_of(const std::string& name, const AxisNames& axes = {});

}  // namespace trunnion::imports

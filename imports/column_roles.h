// What a column of a log or point list is by its name: axis, commanded or actual, speed.
#pragma once

#include <optional>
#include <string>

namespace trunnion::imports {

enum class Role : unsigned char { none, commanded, actual, error, following_error };
enum class Rate : unsigned char { position, velocity, acceleration };

struct ColumnRole {
    char axis = 0;  ///< letter, upper case
    Role role = Role::none;
    Rate rate = Rate::position;
    bool machine = false;  ///< "machine x", "x axis": a position of the axis, not of a point
};

/// "X1_CommandPosition", "Ist X", "x_nom", "B axis velocity"; nothing for a name with a word that
/// says something else (a current, a temperature) or that names no axis.
std::optional<ColumnRole> role_of(const std::string& name);

}  // namespace trunnion::imports

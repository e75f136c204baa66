// What the axes of one machine are called, and which of them turn.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "geometry/axes.h"

namespace trunnion::inline geometry {

/// Latin letters in lower case, all else as it is.
std::string lower_case(std::string_view text);

/// Names by slot. `Axis` is a slot: NC words and all that the control believes mean the letter that
/// owns it; the physical machine may have an axis of another name and kind there. A letter of ISO
/// 841 stands in its own slot, any other name in a slot that no letter of the chain wants; an empty
/// name: the machine has no such axis. By default all nine letters.
struct AxisNames {
    std::array<std::string, axis_count> name{"X", "Y", "Z", "A", "B", "C", "U", "V", "W"};
    std::array<bool, axis_count> rotary{false, false, false, true, true, true, false, false, false};

    const std::string& operator[](Axis axis) const { return name[index_of(axis)]; }
    bool has(Axis axis) const { return !name[index_of(axis)].empty(); }
    bool is_rotary(Axis axis) const { return rotary[index_of(axis)]; }
    std::optional<Axis> find(std::string_view text) const;
    std::optional<Axis> find_column(std::string_view column) const;

    /// "x_mm", "j1_deg".
    std::string column(Axis axis) const;

    friend bool operator==(const AxisNames&, const AxisNames&) = default;
};

}  // namespace trunnion::inline geometry

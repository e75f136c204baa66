// Names and kinds (linear, rotary) of the axes of one machine.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "geometry/axes.h"

namespace trunnion::inline geometry {

/// Latin letters converted to lower case; all other characters are unchanged.
std::string lower_case(std::string_view text);

/// Axis names by slot. `Axis` is a slot. For NC words and the control it is the letter that owns
/// the slot; on the physical machine an axis of another name and kind may use it. A letter of ISO
/// 841 always uses its own slot; any other name uses a slot whose letter is not in the chain. An
/// empty name means that the machine has no such axis. Default: all nine letters.
struct AxisNames {
    std::array<std::string, axis_count> name{"X", "Y", "Z", "A", "B", "C", "U", "V", "W"};
    std::array<bool, axis_count> rotary{false, false, false, true, true, true, false, false, false};

    const std::string& operator[](Axis axis) const { return name[index_of(axis)]; }
    bool has(Axis axis) const { return !name[index_of(axis)].empty(); }
    bool is_rotary(Axis axis) const { return rotary[index_of(axis)]; }
    std::optional<Axis> find(std::string_view text) const;
    std::optional<Axis> find_column(std::string_view column) const;

    /// Name of the column of readings: "x_mm", "j1_deg".
    std::string column(Axis axis) const;

    friend bool operator==(const AxisNames&, const AxisNames&) = default;
};

}  // namespace trunnion::inline geometry

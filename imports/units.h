// Units by their names in files, and factors to mm, rad or s.
#pragma once

#include <optional>
#include <string_view>

namespace trunnion::imports {

enum class Quantity : unsigned char { length, angle, time, speed, turning, per_s2, temperature };

struct Unit {
    Quantity quantity;
    double factor;  ///< to mm, rad, s, mm/s, rad/s, mm/s^2; 1 for deg C
};

/// "um", "µm", "arcsec", "ms", "mm/min", "deg/s" ..., "0.1um" for a count of such steps; empty for
/// an unknown unit.
std::optional<Unit> find_unit(std::string_view name);
/// Of an angle: "h" is 15 degrees, as of hour angles and right ascensions.
std::optional<Unit> find_unit_of_angle(std::string_view name);

}  // namespace trunnion::imports

// Numbers as text that reads back as the same double, independent of the locale.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace trunnion::inline base {

/// The shortest text that reads back as the same double; "0" for -0. Throws InputError for a value
/// that is not finite, so that no file contains "nan".
std::string shortest(double value);
/// An angle in degrees: the shortest text whose value converts back to the same double in rad (or
/// the nearest one if no double in degrees does).
std::string shortest_degrees(double angle_rad);
/// The whole of `text` as a finite number (leading blanks and one + allowed); empty otherwise.
std::optional<double> parse_number(std::string_view text);

}  // namespace trunnion::inline base

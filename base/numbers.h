// Numbers as text that reads back as the same double, independent of the locale.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/finite.h"

namespace trunnion::inline base {

/// The shortest text that reads back to the same double; "0" for -0. A Finite: no file with "nan"
/// in it is written.
std::string shortest(Finite number);
/// An angle in degrees: the shortest text whose value, turned into rad again, is the same double
/// (the nearest where no double of degrees does that).
std::string shortest_degrees(Finite angle_rad);
/// The whole of `text` as a finite number (leading blanks and one + allowed), or nothing.
std::optional<double> parse_number(std::string_view text);

}  // namespace trunnion::inline base

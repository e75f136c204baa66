// Direction of passes stated above a table: "Direction: backward", "Data backward direction".
#pragma once

#include <optional>
#include <string>

namespace trunnion::imports {

/// +1 or -1; 0: both ways. Empty for a text that does not tell it.
std::optional<int> direction_in(const std::string& text);

/// The direction in a heading such as "Data backward direction", "Reverse" or "Sensor AB12 Negative
/// Direction", or "both"; empty for any other line.
std::optional<std::string> direction_of_heading(const std::string& text);

}  // namespace trunnion::imports

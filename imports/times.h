// Time stamps in usual file formats, in seconds.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace trunnion::imports {

/// A date with time of day (2024-03-01T08:15:30.250Z, 2024-03-01 08:15:30, 01.03.2024 08:15:30,
/// 03/25/2024 8:15 PM), as seconds since 1970 in its own time zone (an offset +01:00 is
/// subtracted); or a time of day alone (08:15:30), as seconds since midnight. Empty for any other
/// text, an invalid date, and an ambiguous one such as 01/02/2024.
std::optional<double> seconds_of(std::string_view text);

/// The day at the start of a text, as 2024-03-01, also of a Unix date (Wed Apr 13 14:00:34 CEST
/// 2022); empty for any other text.
std::optional<std::string> day_in(std::string_view text);
/// The day of a time in seconds since 1970.
std::string day_of(double time_s);

}  // namespace trunnion::imports

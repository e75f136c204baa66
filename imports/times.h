// Time stamps as files write them, in seconds.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace trunnion::imports {

/// A date with a time of day (2024-03-01T08:15:30.250Z, 2024-03-01 08:15:30, 01.03.2024 08:15:30,
/// 03/25/2024 8:15 PM), as seconds since 1970 in its own time zone (an offset +01:00 is taken
/// off); or a time of day alone (08:15:30), as seconds since midnight. Nothing for another text, a
/// day that no calendar has, and 01/02/2024, which is two days.
std::optional<double> seconds_of(std::string_view text);

/// The day that a text begins with, as 2024-03-01; nothing where seconds_of reads none.
std::optional<std::string> day_in(std::string_view text);
/// The day of a moment in seconds since 1970.
std::string day_of(double time_s);

}  // namespace trunnion::imports

// Clocks that count ticks since a year: Windows FILETIME, Unix time.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace trunnion::imports {

/// What the numbers of a column of times count.
struct Clock {
    double tick_s = 1.0;
    std::string words;  ///< "Windows FILETIME (100 ns since 1601)"
};

/// The clock whose ticks these numbers are, without any unit: where they are those of the years
/// 2000 to 2060 of one clock alone, and their steps are no longer than readings are apart.
std::optional<Clock> clock_of(const std::vector<double>& numbers);

/// True for whole numbers in steps of one: 0, 1, 2 ... may be seconds or the numbers of the rows.
bool count_rows(const std::vector<double>& numbers);

}  // namespace trunnion::imports

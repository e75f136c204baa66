#include "imports/clocks.h"

#include <cmath>

namespace trunnion::imports {
namespace {

constexpr double year_s = 365.2425 * 86400.0;
constexpr double first_year = 2000.0, last_year = 2060.0;
/// The mean step of Unix times; a clock of microseconds since the start of a controller has the
/// same numbers, but longer steps if they are taken as seconds.
constexpr double longest_step_s = 600.0;
constexpr std::size_t fewest_rows = 3;

struct KnownClock {
    double tick_s, epoch_year;
    const char* words;
};
constexpr KnownClock clocks[] = {
    {1e-7, 1601.0, "Windows FILETIME (100 ns since 1601)"},
    {1e-7, 1.0, "ticks of 100 ns since the year 1"},
    {1e-9, 1970.0, "Unix time in ns"},
    {1e-6, 1970.0, "Unix time in us"},
    {1e-3, 1970.0, "Unix time in ms"},
    {1.0, 1970.0, "Unix time in s"},
};

}  // namespace

std::optional<Clock> clock_of(const std::vector<double>& numbers) {
    if (numbers.empty()) return std::nullopt;
    const double span = numbers.back() - numbers.front();
    const double step = numbers.size() > 1 ? span / static_cast<double>(numbers.size() - 1) : 0.0;
    for (const KnownClock& clock : clocks) {
        const double year = clock.epoch_year + numbers.front() * clock.tick_s / year_s;
        if (year >= first_year && year < last_year &&
            std::abs(step) * clock.tick_s <= longest_step_s)
            return Clock{clock.tick_s, clock.words};
    }
    return std::nullopt;
}

bool count_rows(const std::vector<double>& numbers) {
    for (std::size_t k = 0; k < numbers.size(); ++k)
        if (numbers[k] != std::floor(numbers[k]) || (k > 0 && numbers[k] != numbers[k - 1] + 1.0))
            return false;
    return numbers.size() >= fewest_rows;
}

}  // namespace trunnion::imports

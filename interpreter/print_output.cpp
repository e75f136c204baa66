#include "interpreter/print_output.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>

#include "interpreter/alarms.h"
#include "interpreter/lexical.h"
#include "interpreter/variables.h"

namespace trunnion::interpreter {

std::string decimal_print(double value, int integers, int decimals, bool suppress_zeros) {
    if (is_vacant(value)) value = 0.0;
    const double scale = powers_of_ten[static_cast<std::size_t>(decimals)];
    const double rounded = std::round(std::fabs(value) * scale) / scale;
    std::string digits = fmt::format("{:.{}f}", rounded, decimals);
    const std::size_t point = std::min(digits.find('.'), digits.size());
    const auto places = static_cast<std::size_t>(integers);
    if (point > places) digits.erase(0, point - places);
    const bool minus = value < 0.0 && rounded != 0.0;
    if (suppress_zeros) return (minus ? "-" : "") + digits;
    if (point < places) digits.insert(0, places - point, ' ');
    return (minus ? '-' : ' ') + digits;
}

std::string binary_print(double value, int decimals) {
    if (is_vacant(value)) value = 0.0;
    const double scaled = std::round(value * powers_of_ten[static_cast<std::size_t>(decimals)]);
    if (!(std::fabs(scaled) < 2147483648.0)) raise_language_alarm(110);
    const auto bits = static_cast<std::uint32_t>(static_cast<std::int32_t>(scaled));
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>((bits >> shift) & 255u);
    return bytes;
}

}  // namespace trunnion::interpreter

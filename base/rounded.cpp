#include "base/rounded.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace trunnion::inline base {
namespace {

constexpr const char* nothing = "–";
constexpr int most_decimals_of_sigma = 9;

/// Decimals that show `digits` significant digits of a value above zero.
int decimals_for(double value, int digits) {
    return digits - 1 - static_cast<int>(std::floor(std::log10(value)));
}

}  // namespace

std::string decimal(double value, int decimals) {
    if (!std::isfinite(value)) return nothing;
    const double step = std::pow(10.0, -decimals);
    if (decimals < 0) value = step * std::round(value / step);
    std::string text =
        fmt::format("{:.{}f}", value, std::clamp(decimals, 0, most_decimals_of_sigma));
    const bool zero = text.find_first_of("123456789") == std::string::npos;
    if (zero && text.front() == '-') text.erase(0, 1);
    return text;
}

int decimals_of_sigma(double sigma) {
    if (!std::isfinite(sigma) || sigma <= 0.0) return 3;
    const int decimals = decimals_for(sigma, 2);
    // 0.0996 becomes 0.10, not 0.100.
    const double shown = std::round(sigma * std::pow(10.0, decimals)) / std::pow(10.0, decimals);
    return std::min(decimals_for(shown * (1.0 + 1e-12), 2), most_decimals_of_sigma);
}

std::string three_digits(double value, int most_decimals) {
    if (!std::isfinite(value)) return nothing;
    if (value == 0.0) return "0";
    const int first = decimals_for(std::abs(value), 3);
    const double power = std::pow(10.0, first);
    // 9.996 becomes 10.0, not 10.00.
    const double shown = std::round(std::abs(value) * power) / power;
    const int decimals = std::clamp(decimals_for(shown * (1.0 + 1e-12), 3), 0, most_decimals);
    const std::string text = decimal(value, decimals);
    return text.find_first_of("123456789") == std::string::npos ? "0" : text;
}

std::string percent(double fraction) {
    return decimal(100.0 * fraction, 0);
}

std::string probability_words(double probability) {
    if (probability >= 0.995) return "> 0.99";
    if (probability < 0.005) return "< 0.01";
    return decimal(probability, 2);
}

Rounded rounded(double value, double sigma) {
    if (!std::isfinite(sigma)) return {three_digits(value), nothing};
    const int decimals = decimals_of_sigma(sigma);
    return {decimal(value, decimals), decimal(sigma, decimals)};
}

std::string with_sigma(double value, double sigma) {
    const Rounded text = rounded(value, sigma);
    return std::isfinite(sigma) ? text.value + " ± " + text.sigma : text.value;
}

std::string length_words(double length_um) {
    constexpr double um_per_mm = 1e3;
    return std::abs(length_um) < um_per_mm ? three_digits(length_um, 3) + " µm"
                                           : three_digits(length_um / um_per_mm) + " mm";
}

std::string angle_words(double angle_urad) {
    constexpr double urad_per_mrad = 1e3;
    return std::abs(angle_urad) < urad_per_mrad
               ? three_digits(angle_urad, 3) + " µrad"
               : three_digits(angle_urad / urad_per_mrad) + " mrad";
}

std::string shown_unit(std::string_view unit) {
    for (const std::string_view plain : {"um", "urad"})
        if (unit.starts_with(plain) && (unit.size() == plain.size() || unit[plain.size()] == '/'))
            return "µ" + std::string(unit.substr(1));
    return std::string(unit);
}

}  // namespace trunnion::inline base

#include "base/numbers.h"

#include <array>
#include <charconv>
#include <cmath>

#include "base/units.h"

namespace trunnion::inline base {

std::string shortest(Finite number) {
    const double value = number;
    if (value == 0.0) return "0";
    std::array<char, 32> text;
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
    return {text.data(), end};
}

std::string shortest_degrees(Finite angle_rad) {
    const double middle = deg_from_rad(angle_rad);
    // Most angles were typed with few decimals; then the rounded number is the one typed.
    const double typed = std::round(middle * 1e6) / 1e6;
    if (rad_from_deg(typed) == angle_rad) return shortest(typed);
    std::string best;
    double below = middle, above = middle;
    for (int ulp = 0; ulp < 4; ++ulp) {
        for (const double candidate : {below, above}) {
            if (rad_from_deg(candidate) != angle_rad) continue;
            const std::string text = shortest(candidate);
            if (best.empty() || text.size() < best.size()) best = text;
        }
        below = std::nextafter(below, -INFINITY);
        above = std::nextafter(above, INFINITY);
    }
    return best.empty() ? shortest(middle) : best;
}

std::optional<double> parse_number(std::string_view text) {
    const auto blank = [](char c) { return c == ' ' || c == '\t'; };
    while (!text.empty() && blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && blank(text.back())) text.remove_suffix(1);
    if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
    double value = 0.0;
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (fault != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
        return std::nullopt;
    return value;
}

}  // namespace trunnion::inline base

#include "base/numbers.h"

#include <array>
#include <charconv>
#include <cmath>

#include "base/units.h"

namespace trunnion::inline base {

namespace {

/// A number as text, without allocation.
struct ShortText {
    explicit ShortText(double value)
        : size(static_cast<std::size_t>(
              std::to_chars(text.data(), text.data() + text.size(), value).ptr - text.data())) {}
    explicit operator std::string() const { return {text.data(), size}; }

    std::array<char, 32> text;
    std::size_t size;
};

}  // namespace

std::string shortest(Finite number) {
    const double value = number;
    return value == 0.0 ? "0" : std::string(ShortText(value));
}

std::string shortest_degrees(Finite angle_rad) {
    const double middle = deg_from_rad(angle_rad);
    // Most angles were typed with few decimals; then the rounded number is the one typed.
    const double typed = std::round(middle * 1e6) / 1e6;
    if (rad_from_deg(typed) == angle_rad) return shortest(typed);
    std::optional<ShortText> best;
    const auto look_at = [&](double candidate) {
        if (rad_from_deg(candidate) != angle_rad) return;
        const ShortText text(candidate);
        if (!best || text.size < best->size) best = text;
    };
    look_at(middle);
    double below = middle, above = middle;
    for (int ulp = 1; ulp < 4; ++ulp) {
        look_at(below = std::nextafter(below, -INFINITY));
        look_at(above = std::nextafter(above, INFINITY));
    }
    return best ? std::string(*best) : shortest(middle);
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

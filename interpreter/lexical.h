// Characters, line ends and numbers as a control reads them; inline for speed.
#pragma once

#include <array>
#include <charconv>
#include <cstdint>

namespace trunnion::interpreter {

constexpr char control_z = '\x1a';

constexpr bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
constexpr bool is_blank(char c) {
    return c == ' ' || c == '\t';
}
constexpr bool is_line_end(char c) {
    return c == '\n' || c == '\r';
}
constexpr char upper(char c) {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c;
}
constexpr bool is_letter(char c) {
    return upper(c) >= 'A' && upper(c) <= 'Z';
}

/// Position after the line end at `p`: LF, CR, CR LF, or the control's own LF CR CR.
inline const char* past_line_end(const char* p, const char* end) {
    if (*p++ == '\r') return p != end && *p == '\n' ? p + 1 : p;
    return end - p >= 2 && p[0] == '\r' && p[1] == '\r' ? p + 2 : p;
}

inline const char* find_line_end(const char* p, const char* end) {
    while (p != end && !is_line_end(*p)) ++p;
    return p;
}

inline const char* skip_blanks(const char* p, const char* end) {
    while (p != end && is_blank(*p)) ++p;
    return p;
}

constexpr std::array<double, 16> powers_of_ten{1e0, 1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                               1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};

struct Number {
    double value = 0.0;
    int digits = 0;  ///< 0: no number found
    bool point = false;
};

/// Reads digits with an optional point at `p`, correctly rounded: up to 15 digits as an exact
/// integer divided by an exact power of ten, more digits through the library. Moves `p` past them.
inline Number read_number(const char*& p, const char* end) {
    const char* const first = p;
    std::uint64_t mantissa = 0;
    while (p != end && is_digit(*p)) mantissa = mantissa * 10 + static_cast<unsigned>(*p++ - '0');
    Number n;
    n.digits = static_cast<int>(p - first);
    if (p == end || *p != '.') {
        n.value = static_cast<double>(mantissa);
    } else {
        n.point = true;
        const char* const fraction = ++p;
        while (p != end && is_digit(*p))
            mantissa = mantissa * 10 + static_cast<unsigned>(*p++ - '0');
        const auto decimals = static_cast<std::size_t>(p - fraction);
        n.digits += static_cast<int>(decimals);
        if (n.digits <= 15) n.value = static_cast<double>(mantissa) / powers_of_ten[decimals];
    }
    if (n.digits > 15) std::from_chars(first, p, n.value, std::chars_format::fixed);
    return n;
}

}  // namespace trunnion::interpreter

#include "imports/times.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <chrono>
#include <cmath>

#include "base/numbers.h"
#include "records/table_line.h"

namespace trunnion::imports {
namespace {

std::optional<int> whole(std::string_view& text, std::size_t most_digits) {
    int value = 0;
    const char* const end = text.data() + std::min(text.size(), most_digits);
    const auto [stop, fault] = std::from_chars(text.data(), end, value);
    if (fault != std::errc{} || value < 0) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(stop - text.data()));
    return value;
}

bool skip(std::string_view& text, char c) {
    if (text.empty() || text.front() != c) return false;
    text.remove_prefix(1);
    return true;
}

/// Three numbers separated by the same mark.
std::optional<std::array<int, 3>> three(std::string_view& text, char mark) {
    std::array<int, 3> parts{};
    std::string_view left = text;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto part = whole(left, 4);
        if (!part || (k < 2 && !skip(left, mark))) return std::nullopt;
        parts[k] = *part;
    }
    text = left;
    return parts;
}

std::optional<double> day(int year, int month, int of_month) {
    const std::chrono::year_month_day date{std::chrono::year(year),
                                           std::chrono::month(static_cast<unsigned>(month)),
                                           std::chrono::day(static_cast<unsigned>(of_month))};
    if (!date.ok() || year < 1900) return std::nullopt;
    const auto days = std::chrono::sys_days(date).time_since_epoch();
    return 86400.0 * static_cast<double>(days.count());
}

/// Removes and returns a date at the start of `text`; if there is none, returns empty and leaves
/// `text` unchanged.
std::optional<double> take_date(std::string_view& text) {
    if (const auto iso = three(text, '-')) return day((*iso)[0], (*iso)[1], (*iso)[2]);
    if (const auto german = three(text, '.')) return day((*german)[2], (*german)[1], (*german)[0]);
    if (const auto slash = three(text, '/')) {
        const auto [a, b, c] = *slash;
        if (a > 31) return day(a, b, c);
        if (a <= 12 && b <= 12 && a != b) return std::nullopt;  // month and day are ambiguous
        return a > 12 ? day(c, b, a) : day(c, a, b);
    }
    return std::nullopt;
}

/// Seconds with a fraction after point or comma.
std::optional<double> take_seconds(std::string_view& text) {
    const auto seconds = whole(text, 2);
    if (!seconds || *seconds > 60) return std::nullopt;
    if (text.empty() || (text[0] != '.' && text[0] != ',')) return *seconds;
    std::size_t digits = 1;
    while (digits < text.size() && text[digits] >= '0' && text[digits] <= '9') ++digits;
    const auto fraction = parse_number("0." + std::string(text.substr(1, digits - 1)));
    text.remove_prefix(digits);
    return fraction ? std::optional(*seconds + *fraction) : std::nullopt;
}

std::optional<double> take_clock(std::string_view& text) {
    const auto hours = whole(text, 2);
    if (!hours || *hours > 24 || !skip(text, ':')) return std::nullopt;
    const auto minutes = whole(text, 2);
    if (!minutes || *minutes > 59) return std::nullopt;
    double time_s = 3600.0 * *hours + 60.0 * *minutes;
    if (skip(text, ':')) {
        const auto seconds = take_seconds(text);
        if (!seconds) return std::nullopt;
        time_s += *seconds;
    }
    text = records::without_blanks(text);
    if (text == "PM" || text == "pm") time_s += *hours < 12 ? 43200.0 : 0.0;
    if (text == "AM" || text == "am") time_s -= *hours == 12 ? 43200.0 : 0.0;
    if (text.size() == 2 && (text[1] == 'M' || text[1] == 'm')) text = {};
    return time_s;
}

/// Z, +01:00, -0530 or nothing.
std::optional<double> take_zone(std::string_view text) {
    if (text.empty() || text == "Z") return 0.0;
    const double sign = text[0] == '+' ? 1.0 : -1.0;
    if (text[0] != '+' && text[0] != '-') return std::nullopt;
    text.remove_prefix(1);
    const auto hours = whole(text, 2);
    skip(text, ':');
    const auto minutes = text.empty() ? std::optional(0) : whole(text, 2);
    if (!hours || !minutes || !text.empty()) return std::nullopt;
    return sign * (3600.0 * *hours + 60.0 * *minutes);
}

/// The next word between blanks.
std::string_view take_word(std::string_view& text) {
    text = records::without_blanks(text);
    const std::string_view word = text.substr(0, text.find(' '));
    text.remove_prefix(word.size());
    return word;
}

/// The day of a number, the name of a month (three letters count) and a year.
std::optional<double> named_day(std::string_view of_month, std::string_view name,
                                std::string_view year) {
    static constexpr std::string_view months = "JanFebMarAprMayJunJulAugSepOctNovDec";
    const std::size_t month = months.find(name.substr(0, 3));
    const auto day_number = whole(of_month, 2), year_number = whole(year, 4);
    if (month >= months.size() || month % 3 != 0 || !day_number || !year_number) return {};
    return day(*year_number, static_cast<int>(month / 3) + 1, *day_number);
}

/// The day of "Wed Apr 13 14:00:34 CEST 2022" or "Wed 13 Apr 2022 02:00:34 PM CEST", as `date` of
/// Unix prints it in one language or another.
std::optional<double> day_of_unix(std::string_view text) {
    take_word(text);
    const std::string_view second = take_word(text), third = take_word(text);
    std::string_view fourth = take_word(text), fifth = take_word(text);
    const bool clock_last = !second.empty() && second[0] >= '0' && second[0] <= '9';
    if (clock_last) return take_clock(fifth) ? named_day(second, third, fourth) : std::nullopt;
    if (const std::string_view last = take_word(text); !last.empty()) fifth = last;  // after a zone
    return take_clock(fourth) ? named_day(third, second, fifth) : std::nullopt;
}

}  // namespace

std::optional<std::string> day_in(std::string_view text) {
    text = records::without_blanks(text);
    if (const auto unix_day = day_of_unix(text)) return day_of(*unix_day);
    const auto date = take_date(text);
    return date ? std::optional(day_of(*date)) : std::nullopt;
}

std::string day_of(double time_s) {
    const std::chrono::sys_days days{
        std::chrono::days(static_cast<int>(std::floor(time_s / 86400.0)))};
    const std::chrono::year_month_day date(days);
    return fmt::format("{}-{:02}-{:02}", static_cast<int>(date.year()),
                       static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()));
}

std::optional<double> seconds_of(std::string_view text) {
    text = records::without_blanks(text);
    const bool dated = text.find_first_of("-./") < 5;
    std::optional<double> date = 0.0;
    if (dated && text.find(':') > 4) {
        date = take_date(text);
        if (!date) return std::nullopt;
        if (text.empty()) return date;
        const std::string_view mark = text.substr(0, 1);  // 2021/06/05-13:24:41 is a log's
        if (mark.find_first_of("T -_") == mark.npos) return std::nullopt;
        text.remove_prefix(1);
        text = records::without_blanks(text);
    }
    const auto clock = take_clock(text);
    if (!clock) return std::nullopt;
    const auto zone = take_zone(text);
    if (!zone) return std::nullopt;
    return *date + *clock - *zone;
}

}  // namespace trunnion::imports

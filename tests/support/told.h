// What the program said of generated inputs, kept in files: tests/ROOM/told/NAME.txt. Nobody worked
// these values out by another way: they tell that something changed, not that it was right. A
// wanted change is written anew with TRUNNION_TELL=1 in the environment, and read as a diff.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace trunnion::told {

using Json = nlohmann::ordered_json;

/// Six digits; nothing where rounding alone is left, the sign of which may be either.
inline std::string short_number(double value) {
    return std::abs(value) < 1e-10 ? "0" : fmt::format("{:.6g}", value);
}

/// Numbers of an array that is too long to be kept: count, sum, sum of squares, sum by place.
inline std::string digest(const Json& numbers) {
    double sum = 0.0, squares = 0.0, by_place = 0.0;
    for (std::size_t k = 0; k < numbers.size(); ++k) {
        const double value = numbers[k].is_number() ? numbers[k].get<double>() : 0.0;
        sum += value;
        squares += value * value;
        by_place += value * static_cast<double>(k + 1) / static_cast<double>(numbers.size());
    }
    return fmt::format("{} numbers {} {} {}", numbers.size(), short_number(sum),
                       short_number(squares), short_number(by_place));
}

/// A text without the folder in which this source happens to lie.
inline std::string without_folder(std::string text) {
    constexpr std::string_view folder = TRUNNION_SOURCE_DIR "/";
    for (auto at = text.find(folder); at != std::string::npos; at = text.find(folder, at))
        text.erase(at, folder.size());
    return text;
}

/// Texts and numbers of all values, the numbers in a scale that shows small ones beside large ones.
struct Sums {
    std::size_t letters = 0;
    Json numbers = Json::array();
};

inline void add_sums(const Json& json, Sums& sums) {
    if (json.is_structured())
        for (const Json& item : json) add_sums(item, sums);
    else if (json.is_boolean())
        sums.numbers.push_back(json.get<bool>() ? 1.0 : 2.0);
    else if (json.is_number())
        sums.numbers.push_back(std::asinh(1e3 * json.get<double>()));
    else if (json.is_string())
        for (const char c : without_folder(json.get<std::string>()))
            sums.letters += std::string_view("0123456789.-").find(c) == std::string_view::npos;
}

/// All of it in one line.
inline std::string brief(const Json& json) {
    Sums sums;
    add_sums(json, sums);
    return fmt::format("{} letters, {}", sums.letters, digest(sums.numbers));
}

inline std::string word_of(const Json& value) {
    if (value.is_number_float()) return short_number(value.get<double>());
    if (!value.is_string()) return value.dump();
    constexpr std::size_t longest = 400;
    const Json text = without_folder(value.get<std::string>());
    return text.get_ref<const std::string&>().size() > longest
               ? brief(text)
               : text.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// One line for each value, and for each object of nothing but values:
/// "sides.0 = axis "C" side 1 worse 40.2".
inline void add_lines(const Json& json, const std::string& path, std::vector<std::string>& lines) {
    const auto add = [&](const std::string& text) { lines.push_back(path + " = " + text); };
    const auto is_number = [](const Json& item) { return item.is_number() || item.is_null(); };
    const auto is_value = [](const Json& item) { return !item.is_structured(); };
    if (json.is_object() && std::all_of(json.begin(), json.end(), is_value)) {
        std::string text;
        for (const auto& [key, value] : json.items())
            text += (text.empty() ? "" : " ") + key + " " + word_of(value);
        add(text);
    } else if (json.is_object())
        for (const auto& [key, value] : json.items())
            add_lines(value, path.empty() ? key : path + "." + key, lines);
    else if (json.is_array() && json.size() > 6 && std::all_of(json.begin(), json.end(), is_number))
        add(digest(json));
    else if (json.is_array())
        for (std::size_t k = 0; k < json.size(); ++k)
            add_lines(json[k], fmt::format("{}.{}", path, k), lines);
    else
        add(word_of(json));
}

inline std::vector<std::string> lines_of_json(const std::string& text) {
    std::vector<std::string> lines;
    add_lines(Json::parse(text), "", lines);
    return lines;
}

/// A number at the begin of a text: its length (0: none), value, and one unit of its last digit,
/// which is 0 for a whole number.
struct Number {
    std::size_t size = 0;
    double value = 0.0, digit = 0.0;
};

inline Number number_at(const std::string& text, std::size_t at) {
    if (!std::isdigit(static_cast<unsigned char>(text[at]))) return {};
    const char* begin = text.c_str() + at;
    char* end = nullptr;
    Number number;
    number.value = std::strtod(begin, &end);
    number.size = static_cast<std::size_t>(end - begin);
    const std::string_view word(begin, number.size);
    const std::size_t power = word.find_first_of("eE"), point = word.find('.');
    const int exponent = power == word.npos ? 0 : std::atoi(begin + power + 1);
    if (point != word.npos || power != word.npos) {
        const std::size_t digits_end = std::min(power, word.size());
        const auto places = point == word.npos ? 0 : digits_end - point - 1;
        number.digit = std::pow(10.0, exponent - static_cast<int>(places));
    }
    return number;
}

/// The same words, and numbers as near as other compilers, processors and libraries leave them.
inline bool same_line(const std::string& a, const std::string& b) {
    std::size_t i = 0, k = 0;
    while (i < a.size() && k < b.size()) {
        const Number p = number_at(a, i), q = number_at(b, k);
        if (p.size == 0 || q.size == 0) {
            if (a[i] != b[k]) return false;
            ++i, ++k;
            continue;
        }
        const double allowed = 1.01 * std::max(p.digit, q.digit) + 1e-6 * std::abs(p.value);
        if (std::abs(p.value - q.value) > allowed) return false;
        i += p.size;
        k += q.size;
    }
    return i == a.size() && k == b.size();
}

/// Holds the lines to those of tests/ROOM/told/NAME.txt; the first five that differ are shown.
inline void check_told(const std::string& room, const std::string& name,
                       const std::vector<std::string>& lines) {
    const std::string path =
        std::string(TRUNNION_SOURCE_DIR "/tests/") + room + "/told/" + name + ".txt";
    if (std::getenv("TRUNNION_TELL")) {
        std::ofstream file(path);
        for (const std::string& line : lines) file << without_folder(line) << '\n';
        REQUIRE(file.good());
        return;
    }
    std::ifstream file(path);
    std::vector<std::string> kept;
    for (std::string line; std::getline(file, line);) kept.push_back(line);
    INFO(path);
    CHECK(kept.size() == lines.size());
    int shown = 0;
    for (std::size_t k = 0; k < std::min(kept.size(), lines.size()) && shown < 5; ++k) {
        const std::string now = without_folder(lines[k]);
        if (same_line(kept[k], now)) continue;
        FAIL_CHECK("line " << k + 1 << "\n  kept: " << kept[k] << "\n  now:  " << now);
        ++shown;
    }
}

}  // namespace trunnion::told

#include "imports/cells.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>

#include "base/alarm.h"
#include "base/numbers.h"
#include "imports/times.h"

namespace trunnion::imports {
namespace {

using Cells = std::vector<records::TableCell>;

bool digit(char c) {
    return c >= '0' && c <= '9';
}

/// A comma between two digits, as in 1,5. In 1,250.5 it parts thousands.
bool has_decimal_comma(std::string_view text) {
    for (std::size_t k = 1; k + 1 < text.size(); ++k) {
        if (text[k] != ',' || !digit(text[k - 1]) || !digit(text[k + 1])) continue;
        const std::size_t after = std::min(text.find_first_not_of("0123456789,", k), text.size());
        const bool point = (after - k) % 4 == 0 && after < text.size() && text[after] == '.';
        if (!point) return true;
    }
    return false;
}

/// Marks of a number: "1,250.5" or "1.250,5".
struct Marks {
    char decimal, thousands;
};

/// True where marks of thousands stand before a decimal mark, each before three digits: one kind of
/// number only.
bool parts_thousands(std::string_view text, Marks marks) {
    if (!text.empty() && (text[0] == '-' || text[0] == '+')) text.remove_prefix(1);
    const std::size_t point = text.find(marks.decimal), first = text.find(marks.thousands);
    if (point == std::string_view::npos || first == 0 || first > 3 || first > point) return false;
    if (!std::all_of(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(first), digit))
        return false;
    std::size_t k = first;
    for (; k + 4 <= point && text[k] == marks.thousands; k += 4)
        if (!std::all_of(text.begin() + static_cast<std::ptrdiff_t>(k) + 1,
                         text.begin() + static_cast<std::ptrdiff_t>(k) + 4, digit))
            return false;
    return k == point && text.find(marks.thousands, point) == std::string_view::npos;
}

bool is_blank(char c) {
    return c == ' ' || c == '\t';
}

/// A number between two separators. Quotes are not looked at: a remark may have one.
bool number_between(std::string_view text, char separator) {
    const Dialect point{separator, false}, comma{separator, separator != ','};
    for (std::size_t k = 0; k <= text.size();) {
        const std::size_t end = std::min(text.find(separator, k), text.size());
        std::string_view cell = records::without_blanks(text.substr(k, end - k));
        if (cell.size() > 1 && cell.front() == '"' && cell.back() == '"')
            cell = cell.substr(1, cell.size() - 2);
        if (point.find_number(cell) || comma.find_number(cell)) return true;
        k = end + 1;
    }
    return false;
}

/// Largest number of consecutive lines that `separator` splits into the same number of cells, two
/// or more, at least one of them a number. Lines of remarks have commas too.
std::size_t longest_run(const std::vector<records::TableLine>& lines, char separator) {
    std::size_t best = 0, run = 0;
    bool numbers = false;
    std::ptrdiff_t last = 0;
    for (const records::TableLine& line : lines) {
        const auto count = std::count(line.text.begin(), line.text.end(), separator);
        const bool goes_on = count > 0 && count == last;
        run = goes_on ? run + 1 : 1;
        last = count;
        if (count == 0) continue;
        numbers = (goes_on && numbers) || number_between(line.text, separator);
        if (numbers) best = std::max(best, run);
    }
    return best;
}

/// Largest number of consecutive lines of as many numbers, two or more, between blanks only.
std::size_t longest_run_between_blanks(const std::vector<records::TableLine>& lines) {
    const Dialect point{' ', false};
    std::size_t best = 0, run = 0, last = 0;
    for (const records::TableLine& line : lines) {
        const Cells cells = cells_of(line, ' ');
        const bool numbers =
            cells.size() > 1 && std::all_of(cells.begin(), cells.end(), [&](const auto& cell) {
                return point.find_number(cell.text).has_value();
            });
        run = !numbers ? 0 : cells.size() == last ? run + 1 : 1;
        last = cells.size();
        best = std::max(best, run);
    }
    return best;
}

/// A line of numbers only, two or more between blanks, at least one with this decimal mark:
/// "0,5  1,25". Remarks hold other words.
bool marks_between_blanks(const std::vector<records::TableLine>& lines, char mark) {
    const Dialect dialect{' ', mark == ','};
    for (const records::TableLine& line : lines) {
        const Cells cells = cells_of(line, ' ');
        const auto number = [&](const auto& cell) { return dialect.find_number(cell.text); };
        const bool marked = mark == ',' ? has_decimal_comma(line.text)
                                        : line.text.find(mark) != std::string_view::npos;
        if (cells.size() > 1 && marked && std::all_of(cells.begin(), cells.end(), number))
            return true;
    }
    return false;
}

}  // namespace

std::optional<double> Dialect::find_number(std::string_view text) const {
    const Marks marks = decimal_comma ? Marks{',', '.'} : Marks{'.', ','};
    const bool thousands = text.find(marks.thousands) != std::string_view::npos;
    if (thousands && !parts_thousands(text, marks)) return std::nullopt;
    if (!thousands && !decimal_comma) return parse_number(text);
    std::string point(text);
    if (thousands) std::erase(point, marks.thousands);
    std::replace(point.begin(), point.end(), ',', '.');
    return parse_number(point);
}

std::vector<records::TableCell> cells_of(const records::TableLine& line, char separator) {
    Cells cells;
    if (separator != ' ') {
        line.split(separator, cells);
        return cells;
    }
    const std::string_view text = line.text;
    for (std::size_t k = 0; k < text.size();) {
        if (is_blank(text[k])) {
            ++k;
            continue;
        }
        const std::size_t end = std::min(text.find_first_of(" \t", k), text.size());
        cells.push_back({text.substr(k, end - k), static_cast<int>(k) + 1, false});
        k = end;
    }
    return cells;
}

std::vector<records::TableCell> cells_apart(std::string_view text) {
    Cells cells;
    std::size_t k = 0;
    while ((k = text.find_first_not_of(" \t", k)) != std::string_view::npos) {
        std::size_t end = k;
        while (end < text.size() && text[end] != '\t' &&
               !(text[end] == ' ' && (end + 1 == text.size() || is_blank(text[end + 1]))))
            ++end;
        cells.push_back({text.substr(k, end - k), static_cast<int>(k) + 1, false});
        k = end;
    }
    return cells;
}

void drop_empty_end(std::vector<records::TableCell>& cells) {
    while (!cells.empty() && cells.back().text.empty()) cells.pop_back();
}

bool is_missing(std::string_view text) {
    static constexpr std::array<std::string_view, 12> words{
        "-",  "--",   "---",  "?",    "nan",          "n/a",
        "na", "n.a.", "null", "#n/a", "out of range", "overrange"};
    if (text.find_first_not_of('*') == std::string_view::npos) return true;  // also when empty
    std::string lower(text);
    for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return std::find(words.begin(), words.end(), lower) != words.end();
}

bool has_number(const Cells& cells, const Dialect& dialect) {
    return std::any_of(cells.begin(), cells.end(),
                       [&](const auto& cell) { return dialect.find_number(cell.text); });
}

bool is_data(const Cells& cells, const Dialect& dialect) {
    return has_number(cells, dialect) ||
           std::any_of(cells.begin(), cells.end(), [](const auto& cell) {
               return (!cell.text.empty() && is_missing(cell.text)) || seconds_of(cell.text);
           });
}

Dialect dialect_of(const std::vector<records::TableLine>& lines) {
    Dialect dialect{' ', false};
    const std::size_t blanks = longest_run_between_blanks(lines);
    std::size_t best = 1;
    for (const char candidate : {'\t', ';', ',', '|'}) {
        // With ; or tabs, and between blanks, commas are decimal marks.
        if (candidate == ',' && (best > 1 || marks_between_blanks(lines, ','))) continue;
        const std::size_t run = longest_run(lines, candidate);
        if (run <= best || run < blanks) continue;
        best = run;
        dialect.separator = candidate;
    }
    if (dialect.separator == ',') return dialect;
    dialect.decimal_comma = std::any_of(lines.begin(), lines.end(), [](const auto& line) {
        return line.text[0] != '#' && has_decimal_comma(line.text);
    });
    if (dialect.separator == ' ' && marks_between_blanks(lines, '.')) dialect.decimal_comma = false;
    const bool one = cells_of(lines.back(), ' ').size() == 1;
    if (dialect.separator == ' ' && dialect.decimal_comma && one)
        throw InputError("a comma may be decimal mark or separator here: use ; between columns",
                         {std::string(lines.back().path), lines.back().number, 1},
                         std::string(lines.back().text));
    return dialect;
}

}  // namespace trunnion::imports

#include "records/table_line.h"

#include <algorithm>
#include <cmath>

#include "base/alarm.h"
#include "base/numbers.h"

namespace trunnion::records {
namespace {

bool blank(char c) {
    return c == ' ' || c == '\t';
}

/// Position after the quote that closes the one at `open`; npos if there is none.
std::size_t behind_quote(std::string_view text, std::size_t open) {
    for (std::size_t at = text.find('"', open + 1); at != std::string_view::npos;
         at = text.find('"', at + 2))
        if (at + 1 >= text.size() || text[at + 1] != '"') return at + 1;
    return std::string_view::npos;
}

}  // namespace

std::string TableCell::plain() const {
    std::string out;
    for (std::size_t k = 0; k < text.size(); ++k) {
        out += text[k];
        if (quoted && text[k] == '"') ++k;
    }
    return out;
}

void TableLine::fail(const std::string& message, int column) const {
    throw InputError(message, {std::string(path), number, column}, std::string(text));
}

void TableLine::split(char separator, std::vector<TableCell>& cells) const {
    cells.clear();
    for (std::size_t start = 0;;) {
        const bool quoted = start < text.size() && text[start] == '"';
        const int column = static_cast<int>(start) + 1;
        const std::size_t behind = quoted ? behind_quote(text, start) : start;
        if (behind == std::string_view::npos) fail("quote is not closed", column);
        const std::size_t end = std::min(text.find(separator, behind), text.size());
        if (quoted) {
            if (!without_blanks(text.substr(behind, end - behind)).empty())
                fail("text behind a closed quote", static_cast<int>(behind) + 1);
            cells.push_back({text.substr(start + 1, behind - start - 2), column, true});
        } else {
            cells.push_back({without_blanks(text.substr(start, end - start)), column, false});
        }
        if (end == text.size()) return;
        start = end + 1;
    }
}

Finite TableLine::number_of(const TableCell& cell, std::string_view what) const {
    const auto value = parse_number(cell.text);
    if (!value)
        fail(std::string(what) + ": '" + std::string(cell.text) + "' is not a finite number" +
                 (cell.text.find(',') != std::string_view::npos ? " (write a decimal point)" : ""),
             cell.column);
    constexpr double largest = 1e9;  // mm, deg, s, mm/min: larger values overflow in squares and
                                     // products
    if (std::abs(*value) > largest)
        fail(std::string(what) + ": " + std::string(cell.text) + " is beyond 1e9", cell.column);
    return *value;
}

std::string_view without_blanks(std::string_view text) {
    while (!text.empty() && blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && blank(text.back())) text.remove_suffix(1);
    return text;
}

std::string_view take_line(std::string_view& text) {
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    const std::string_view line = text.substr(0, end);
    const bool pair = end + 1 < text.size() && text[end] == '\r' && text[end + 1] == '\n';
    text.remove_prefix(std::min(end + (pair ? 2 : 1), text.size()));
    return line;
}

char separator_of(std::string_view header) {
    for (const char c : {',', '\t', ';'})
        if (header.find(c) != std::string_view::npos) return c;
    return ',';
}

std::string cell_text(const std::string& text) {
    const bool plain = text.find_first_of(",\"") == std::string::npos &&
                       (text.empty() || (!blank(text.front()) && !blank(text.back())));
    if (plain) return text;
    std::string out = "\"";
    for (const char c : text) out += c == '"' ? "\"\"" : std::string(1, c);
    return out + '"';
}

}  // namespace trunnion::records

#include "imports/printed_lines.h"

#include "base/alarm.h"
#include "base/numbers.h"
#include "records/table_line.h"

namespace trunnion::imports {
namespace {

/// Removes blanks, `%`, XON, XOFF and similar characters.
std::string_view bare(std::string_view line) {
    const auto idle = [](char c) { return static_cast<unsigned char>(c) <= ' ' || c == '%'; };
    while (!line.empty() && idle(line.front())) line.remove_prefix(1);
    while (!line.empty() && idle(line.back())) line.remove_suffix(1);
    return line;
}

}  // namespace

void PrintedLine::fail(const std::string& message, std::size_t column) const {
    throw InputError(message, {std::string(path), number, static_cast<int>(column) + 1},
                     std::string(text));
}

std::string_view PrintedLine::word() const {
    return text.substr(0, text.find(' '));
}

double PrintedLine::number_behind(char letter) const {
    const std::size_t at = text.find(std::string{' ', letter});
    if (at == std::string_view::npos) fail(std::string(1, letter) + " is missing in this line");
    std::string_view left = text.substr(at + 2);
    const bool negative = left.starts_with('-');
    if (negative) left.remove_prefix(1);
    const std::size_t begin = std::min(left.find_first_not_of(' '), left.size());
    left.remove_prefix(begin);
    left = left.substr(0, left.find(' '));
    const auto value =
        left.starts_with('-') || left.starts_with('+') ? std::nullopt : parse_number(left);
    if (!value) fail("no number behind " + std::string(1, letter), at + 1);
    return negative ? -value.value_or(0.0) : value.value_or(0.0);
}

Vector3 PrintedLine::vector_behind(std::string_view letters) const {
    return {number_behind(letters[0]), number_behind(letters[1]), number_behind(letters[2])};
}

std::optional<PrintedLine> next_line(std::string_view& text, int& number, std::string_view path) {
    while (!text.empty()) {
        ++number;
        const std::string_view line = bare(records::take_line(text));
        if (!line.empty()) return PrintedLine{line, number, path};
    }
    return std::nullopt;
}

}  // namespace trunnion::imports

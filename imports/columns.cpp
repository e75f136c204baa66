#include "imports/columns.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "base/alarm.h"
#include "base/numbers.h"

namespace trunnion::imports {
namespace {

bool upper(char c) {
    return std::isupper(static_cast<unsigned char>(c)) != 0;
}
bool word_part(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || (c & 0x80) != 0;
}

}  // namespace

std::vector<std::string> words_of(const std::string& name) {
    std::vector<std::string> words;
    std::string word;
    for (std::size_t k = 0; k <= name.size(); ++k) {
        const bool part = k < name.size() && word_part(name[k]);
        const bool hump = part && k > 0 && upper(name[k]) && !upper(name[k - 1]);
        if ((!part || hump) && !word.empty()) words.push_back(std::exchange(word, {}));
        if (part) word += static_cast<char>(std::tolower(static_cast<unsigned char>(name[k])));
    }
    return words;
}

std::string without_index(const std::string& name) {
    std::vector<std::string> words = words_of(name);
    const auto is_index = [](const std::string& w) { return w == "i" || w == "j" || w == "ij"; };
    std::size_t end = words.size();
    while (end > 0 && is_index(words[end - 1])) --end;
    // "x(i,j)" may be anything.
    if (end == 0 || (end == 1 && words[0].size() == 1)) end = words.size();
    std::string out;
    for (std::size_t k = 0; k < end; ++k) out += (k == 0 ? "" : " ") + words[k];
    return out;
}

std::string plain_name(const std::string& name) {
    std::string out = without_index(name);
    std::erase(out, ' ');
    return out;
}

std::optional<std::size_t> find_column(const TextTable& table,
                                       const std::vector<std::string>& names) {
    std::optional<std::size_t> found;
    for (std::size_t k = 0; k < table.columns().size(); ++k) {
        const std::string name = plain_name(table.columns()[k].name);
        if (std::find(names.begin(), names.end(), name) == names.end()) continue;
        if (found)
            table.header_line().fail("'" + table.columns()[k].name + "' and '" +
                                         table.columns()[*found].name + "' hold the same",
                                     table.columns()[k].column);
        found = k;
    }
    return found;
}

std::optional<std::size_t> find_first_column(const TextTable& table,
                                             const std::vector<std::vector<std::string>>& lists) {
    for (const std::vector<std::string>& names : lists)
        if (const auto found = find_column(table, names)) return found;
    return std::nullopt;
}

std::optional<std::size_t> sigma_column(const TextTable& table) {
    return find_column(table, {"sigma", "u", "uncertainty", "unsicherheit", "sd", "std", "stdev",
                               "stddev", "standarddeviation", "standardabweichung", "\xCF\x83"});
}

NumberColumn number_column(const TextTable& table, std::size_t index, Quantity quantity,
                           const std::string& otherwise) {
    const TextColumn& column = table.columns()[index];
    const std::string& name = column.unit.empty() ? otherwise : column.unit;
    // Hours only in the column's own name: one told for all would be that of a declination too.
    const bool hours = quantity == Quantity::angle && !column.unit.empty();
    const auto unit = hours ? find_unit_of_angle(name) : find_unit(name);
    if (name.empty())
        table.header_line().fail("the unit of '" + column.name +
                                     "' is not told: in its name ([um]), in a row of units, or "
                                     "--with unit=um",
                                 column.column);
    if (!unit || unit->quantity != quantity) {
        const bool turned =
            unit && unit->quantity == Quantity::angle && quantity == Quantity::length;
        table.header_line().fail(
            "'" + name + "' is no unit for '" + column.name + "' here" +
                (turned ? ": it is a unit of angle, and no rotary axis is told" : ""),
            column.column);
    }
    const bool parts =
        quantity == Quantity::angle && (unit->factor == find_unit_of_angle("deg")->factor ||
                                        unit->factor == find_unit_of_angle("h")->factor);
    return {index, unit->factor, parts, quantity != Quantity::time};
}

namespace {

/// Whole units, minutes and seconds, each below 60, divided by colons.
std::optional<double> from_sexagesimal(std::string_view text) {
    text = records::without_blanks(text);
    const bool negative = text.starts_with('-');
    if (negative || text.starts_with('+')) text.remove_prefix(1);
    double sum = 0.0, unit = 1.0;
    for (int part = 0; part < 3; ++part, unit /= 60.0) {
        const std::size_t end = part < 2 ? text.find(':') : text.size();
        if (end == std::string_view::npos || text.empty() || text.front() < '0' ||
            text.front() > '9')
            return std::nullopt;
        const auto value = parse_number(text.substr(0, end));
        if (!value || (part > 0 && *value >= 60.0)) return std::nullopt;
        sum += *value * unit;
        text.remove_prefix(std::min(text.size(), end + 1));
    }
    return negative ? -sum : sum;
}

}  // namespace

double number_in(const TextTable& table, std::size_t row,
                 const std::vector<records::TableCell>& cells, const NumberColumn& column) {
    const records::TableCell& cell = cells[column.index];
    const std::string& name = table.columns()[column.index].name;
    if (const auto value = table.find_number(cell.text)) {
        const double number = *value * column.factor;
        if (column.limited && std::abs(number) > largest_number)
            table.line(row).fail(beyond_largest, cell.column);
        return number;
    }
    if (column.sexagesimal)
        if (const auto value = from_sexagesimal(cell.text)) return *value * column.factor;
    const std::size_t cut = cell.text.find_first_not_of("+-0123456789.,eE ");
    if (cut != std::string_view::npos && cut > 0 && find_unit(cell.text.substr(cut)))
        table.line(row).fail("a unit in the cell: '" + name +
                                 "' has one unit, told in its name or in a row of units",
                             cell.column);
    return table.number(row, cell, name);
}

}  // namespace trunnion::imports

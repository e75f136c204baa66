#include "imports/text_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "base/alarm.h"
#include "base/numbers.h"
#include "imports/column_names.h"
#include "imports/export_head.h"
#include "imports/head_value.h"
#include "imports/headings.h"
#include "imports/told_direction.h"
#include "imports/units.h"

namespace trunnion::imports {
namespace {

/// Number of lines examined to determine the format and the start of a table.
constexpr std::size_t sample_lines = 200;
constexpr std::size_t longest_unit = 10;  ///< letters
constexpr std::size_t longest_head = 30;  ///< maximum number of lines between two tables
const std::string heading_direction = "heading direction";

using Line = TextTable::Line;
using Cells = std::vector<records::TableCell>;

std::string lower(std::string_view text) {
    std::string out(text);
    for (char& c : out) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return out;
}

bool one_of(char c, std::string_view set) {
    return set.find(c) != std::string_view::npos;
}

/// "|:---:|---|" or "+---+" between the names and the rows.
bool is_rule(std::string_view text, const Dialect& dialect) {
    return dialect.separator == '|' && text.find_first_not_of("-|:+= \t") == std::string_view::npos;
}

bool is_blank_row(std::string_view text, const Dialect& dialect) {
    const char set[] = {dialect.separator, ' ', '\t', '"', '\0'};
    return text.find_first_not_of(set) == std::string_view::npos;
}

std::string unit_in(const records::TableCell& cell) {
    std::string unit = cell.plain();
    std::erase_if(unit, [](char c) { return one_of(c, "[]()"); });
    return unit;
}

/// "# time x": names after a comment mark, as plotting tools write them.
std::string_view without_mark(std::string_view text) {
    const std::size_t begin = text.find_first_not_of("#%");
    return begin == std::string_view::npos ? std::string_view() : text.substr(begin);
}

bool begins_with_number(std::string_view text) {
    const std::size_t k = text.find_first_not_of(" \t\"");
    return k != std::string_view::npos && one_of(text[k], "0123456789+-.");
}

/// True for numbers only, or after a single name as in "Position;0;100;200".
bool mostly_numbers(const Cells& cells, const Dialect& dialect) {
    const auto number = [&](const auto& cell) { return dialect.find_number(cell.text); };
    return std::all_of(cells.begin() + 1, cells.end(), number) && cells.size() > 1;
}

/// True for a row of numbers of an axis; "Feed;1000" is a line above a table.
bool row_like(const Cells& cells, const Dialect& dialect) {
    if (cells.size() < 2 || !is_data(cells, dialect)) return false;
    const std::string_view first = cells.front().text;
    return cells.size() > 2 || is_data({cells.front()}, dialect) || first.empty();
}

}  // namespace

TextTable::TextTable(const std::vector<Line>& lines, std::size_t begin, std::string path,
                     Dialect dialect, const std::string& told)
    : path_(std::move(path)), dialect_(dialect) {
    const auto exported =
        told.empty() ? find_export_head(lines, begin, dialect) : std::optional<ExportHead>();
    const std::size_t at = exported       ? exported->names
                           : told.empty() ? find_header(lines, begin)
                                          : first_told_row(lines, begin, told);
    if (begin < lines.size()) first_line_ = lines[begin].number;
    read_head(lines, begin, at);
    headings_ = headings_above(lines, begin, at);
    if (at == lines.size()) return;
    const std::size_t behind = told.empty() ? read_header(lines, begin, at) : at;
    if (exported) columns_.front().name = "time";
    take_rows(lines, exported ? exported->first_row : behind);
    if (exported && exported->units)
        take_units(cells(lines[*exported->units]));
    else if (told.empty() && !rows_.empty() && is_units(rows_.front()))
        take_units_of_first_row();
    if (rows_.empty()) throw InputError("the table has no rows", {path_, header_.number, 1});
}

std::vector<records::TableCell> TextTable::header_cells(const Line& line, std::size_t width) const {
    const records::TableLine bare{without_mark(line.text), line.number, path_};
    Cells names = cells_of(bare, dialect_.separator);
    if (dialect_.separator == ' ' && names.size() != width)
        if (Cells apart = cells_apart(bare.text); apart.size() == width) return apart;
    drop_empty_end(names);
    return names;
}

bool TextTable::is_units(const Line& line) const {
    const Cells names = cells(line);
    std::size_t units = 0, words = 0;
    for (const records::TableCell& cell : names) {
        const std::string unit = unit_in(cell);
        if (unit.empty() || unit == "-") continue;
        ++(find_unit(unit) ? units : words);
        if (unit.size() > longest_unit) return false;
    }
    return units > 0 && 2 * words <= units && !has_number(names, dialect_);
}

/// Number of rows (at most two) after lines[header] with as many cells as it has names.
std::size_t TextTable::rows_behind(const std::vector<Line>& lines, std::size_t header) const {
    if (is_rule(lines[header].text, dialect_)) return 0;
    const auto past_rule = [&](std::size_t i) {
        return i + (i < lines.size() && is_rule(lines[i].text, dialect_) ? 1 : 0);
    };
    std::size_t first = past_rule(header + 1);
    if (first < lines.size() && is_units(lines[first])) first = past_rule(first + 1);
    std::size_t count = 0;
    for (std::size_t i = first; i < std::min(lines.size(), first + 2); ++i) {
        Cells row = cells(lines[i]);
        const Cells names = header_cells(lines[header], row.size());
        const bool words =
            names.size() > 1 &&
            (!has_number(names, dialect_) || (names.size() > 3 && mostly_numbers(names, dialect_)));
        if (!words || row.size() < names.size() || !row_like(row, dialect_)) break;
        drop_empty_end(row);
        if (row.size() > names.size()) break;
        ++count;
    }
    return count;
}

/// The first line of names with two rows after it. If there is none: in the first table the line of
/// the widest row, in a further table none.
std::size_t TextTable::find_header(const std::vector<Line>& lines, std::size_t begin) const {
    const std::size_t end = std::min(lines.size(), begin + sample_lines);
    for (std::size_t i = begin; i < end; ++i)
        if (rows_behind(lines, i) == 2) return i;
    return begin == 0 ? widest(lines) : lines.size();
}

std::size_t TextTable::widest(const std::vector<Line>& lines) const {
    const std::size_t end = std::min(lines.size(), sample_lines);
    std::size_t width = 0, full = 0;  // without and with empty cells at the end
    for (std::size_t i = 0; i < end; ++i)
        if (Cells row = cells(lines[i]); has_number(row, dialect_)) {
            full = std::max(full, row.size());
            drop_empty_end(row);
            width = std::max(width, row.size());
        }
    for (std::size_t i = 0; i < end && width > 0; ++i) {
        if (lines[i].text[0] == '#' || is_rule(lines[i].text, dialect_)) continue;
        const std::size_t names = header_cells(lines[i], width).size();
        if (names == width || names == full) return i;
    }
    throw InputError("no table: no line of numbers in the first 200", {path_, 1, 1});
}

/// Returns the first line behind the names.
std::size_t TextTable::read_header(const std::vector<Line>& lines, std::size_t begin,
                                   std::size_t at) {
    header_ = lines[at];
    const std::size_t width = at + 1 < lines.size() ? cells(lines[at + 1]).size() : 0;
    const Cells names = header_cells(header_, width);
    if (std::all_of(names.begin(), names.end(), [&](auto& c) { return find_number(c.text); }))
        header_line().fail(
            "numbers where the names of the columns are expected (--with columns=\"time [s], X cmd "
            "[mm], X act [mm]\" tells them)",
            1);
    columns_ = columns_named(names);
    const Line* above = at > begin ? &lines[at - 1] : nullptr;
    const Line* below = at + 1 < lines.size() ? &lines[at + 1] : nullptr;
    if (above && join_names(cells(*above), names, columns_)) header_ = *above;
    const bool joined = below && join_names(names, cells(*below), columns_);
    return at + (joined ? 2 : 1);
}

/// A number or a time where a column has a unit or is that of times: no line of a head, such as
/// "Start;132907764534190000;Thursday, March 3, 2022".
bool TextTable::fits(const Cells& row) const {
    for (std::size_t k = 0; k < row.size(); ++k) {
        const bool number = !columns_[k].unit.empty() || lower(columns_[k].name) == "time";
        if (number && !is_data({row[k]}, dialect_) && !begins_with_number(row[k].text) &&
            !row[k].text.empty())
            return false;
    }
    return has_number(row, dialect_);
}

/// Columns as given by the user; the first line with as many numbers.
std::size_t TextTable::first_told_row(const std::vector<Line>& lines, std::size_t begin,
                                      const std::string& told) {
    Cells names;
    records::TableLine{told, 1, "--with columns"}.split(',', names);
    for (const records::TableCell& cell : names) columns_.push_back(column_named(cell.plain(), 1));
    for (std::size_t i = begin; i < lines.size(); ++i) {
        Cells row = cells(lines[i]);
        drop_empty_end(row);
        if (row.size() == columns_.size() && fits(row)) {
            header_ = lines[i];
            return i;
        }
    }
    if (begin > 0) return lines.size();
    throw InputError(fmt::format("no line with {} numbers, the number of names in --with columns",
                                 columns_.size()),
                     {path_, 1, 1});
}

/// A short line such as "Section;2", closely followed by names and rows of another table.
bool TextTable::leads_to_header(const std::vector<Line>& lines, std::size_t at) const {
    const std::size_t end = std::min(lines.size(), at + longest_head);
    for (std::size_t i = at + 1; i < end && !begins_with_number(lines[i].text); ++i)
        if (rows_behind(lines, i) == 2) return true;
    return false;
}

/// A row of this table soon after a short line, which is then a row that lost cells, not the first
/// of the results below the table.
bool TextTable::row_follows(const std::vector<Line>& lines, std::size_t at) const {
    const std::size_t end = std::min(lines.size(), at + longest_head);
    for (std::size_t i = at + 1; i < end; ++i) {
        Cells row = cells(lines[i]);
        drop_empty_end(row);
        if (row.size() == columns_.size() && row_like(row, dialect_)) return true;
    }
    return false;
}

/// Takes rows up to a text line, i.e. the end or the head of another table.
void TextTable::take_rows(const std::vector<Line>& lines, std::size_t begin) {
    for (std::size_t i = end_ = begin; i < lines.size(); ++i) {
        const Line& line = lines[i];
        if (line.text[0] == '#') continue;  // between rows; before the next table part of its head
        if (is_rule(line.text, dialect_)) continue;
        if (is_blank_row(line.text, dialect_)) continue;  // ";;;" of a spreadsheet
        if (!begins_with_number(line.text) && !(i == begin && is_units(line))) {
            const Cells row = cells(line);
            const bool says = line.text.find_first_of(":=") != std::string_view::npos;
            if (!is_data(row, dialect_)) return;
            if (row.size() < columns_.size() &&
                (says || leads_to_header(lines, i) || !row_follows(lines, i)))
                return;
        }
        rows_.push_back(line);
        end_ = i + 1;
    }
    end_ = lines.size();
}

void TextTable::take_units(const Cells& names) {
    for (std::size_t k = 0; k < std::min(names.size(), columns_.size()); ++k) {
        if (const std::string unit = unit_in(names[k]); find_unit(unit)) columns_[k].unit = unit;
    }
}

/// A line with units only below the names: "s;mm;mm".
void TextTable::take_units_of_first_row() {
    const Cells names = cells(rows_.front());
    if (names.size() < columns_.size()) return;
    take_units(names);
    rows_.erase(rows_.begin());
}

/// Lines above the table: "Feed: 1000", "# plane = XY" or "Feed;1000".
void TextTable::read_head(const std::vector<Line>& lines, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
        std::string_view text = lines[i].text;
        while (!text.empty() && one_of(text[0], "#%*! \"")) text.remove_prefix(1);
        if (const auto way = direction_of_heading(std::string(text)))
            head_[heading_direction] = {*way, lines[i]};
        const std::string cuts = std::string(":=;\t") + (dialect_.separator == ',' ? "," : "");
        const std::size_t cut = text.find_first_of(cuts);
        if (cut == std::string_view::npos) continue;
        std::string key = lower(records::without_blanks(text.substr(0, cut)));
        std::erase(key, '"');
        head_[key] = {head_value(text.substr(cut), cuts), lines[i]};
    }
    const auto way = head_.find(heading_direction);
    if (way != head_.end() && end < lines.size() &&
        section_ends(lines, way->second.line, lines[end].number))
        head_.erase(way);
}

void TextTable::inherit(const Head& above, const std::vector<Line>& lines) {
    const bool known = head_.contains(heading_direction);
    head_.insert(above.begin(), above.end());
    const auto way = head_.find(heading_direction);
    if (known || way == head_.end()) return;
    const Line& told = way->second.line;
    const bool other_words = !told.text.starts_with('#') && !headings_.empty();
    if (other_words || section_ends(lines, told, header_.number)) head_.erase(way);
}

bool TextTable::says_itself(const std::string& key) const {
    const auto entry = head_.find(key);
    return entry != head_.end() && entry->second.line.number >= first_line_;
}

std::string TextTable::dialect_words() const {
    const char separator = dialect_.separator;
    const std::string between = separator == '\t'  ? "tabs"
                                : separator == ' ' ? "blanks"
                                                   : std::string("'") + separator + '\'';
    return between + " between columns, decimal " + (dialect_.decimal_comma ? "comma" : "point");
}

void TextTable::read(std::size_t i, std::vector<records::TableCell>& row) const {
    if (dialect_.separator == ' ')
        row = cells_of(line(i), ' ');
    else
        line(i).split(dialect_.separator, row);
    while (row.size() > columns_.size() && row.back().text.empty()) row.pop_back();
    if (row.size() != columns_.size())
        line(i).fail("row has " + std::to_string(row.size()) + " cells, the header " +
                         std::to_string(columns_.size()),
                     row.size() < columns_.size() ? static_cast<int>(rows_[i].text.size()) + 1
                                                  : row[columns_.size()].column);
}

double TextTable::number(std::size_t i, const records::TableCell& cell,
                         std::string_view what) const {
    if (const auto value = find_number(cell.text)) return *value;
    line(i).fail(std::string(what) + ": '" + std::string(cell.text) + "' is not a finite number" +
                     (dialect_.decimal_comma ? " with a decimal comma, as the others here" : ""),
                 cell.column);
}

bool TextTable::has_numbers(std::size_t column) const {
    Cells row;
    for (std::size_t i = 0; i < size(); ++i) {
        read(i, row);
        if (find_number(row[column].text)) return true;
    }
    return false;
}

void TextTable::fail(std::size_t i, std::size_t column, const std::string& message) const {
    Cells row;
    read(i, row);
    line(i).fail(message, row[column].column);
}

}  // namespace trunnion::imports

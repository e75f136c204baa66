#include "imports/text_table.h"

#include <algorithm>
#include <cctype>

#include "base/alarm.h"
#include "base/numbers.h"
#include "imports/units.h"

namespace trunnion::imports {
namespace {

/// Lines at the start that decide how a file is written.
constexpr std::size_t sample_lines = 200;

std::string lower(std::string_view text) {
    std::string out(text);
    for (char& c : out) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return out;
}

bool digit(char c) {
    return c >= '0' && c <= '9';
}

/// A comma between two digits, as in 1,5.
bool has_decimal_comma(std::string_view text) {
    for (std::size_t k = 1; k + 1 < text.size(); ++k)
        if (text[k] == ',' && digit(text[k - 1]) && digit(text[k + 1])) return true;
    return false;
}

/// Blanks as separator: runs of them count as one.
std::vector<records::TableCell> split_blanks(std::string_view text) {
    std::vector<records::TableCell> cells;
    for (std::size_t k = 0; k < text.size();) {
        if (text[k] == ' ' || text[k] == '\t') {
            ++k;
            continue;
        }
        const std::size_t end = std::min(text.find_first_of(" \t", k), text.size());
        cells.push_back({text.substr(k, end - k), static_cast<int>(k) + 1, false});
        k = end;
    }
    return cells;
}

std::vector<records::TableCell> cells_of(const records::TableLine& line, char separator) {
    if (separator == ' ') return split_blanks(line.text);
    std::vector<records::TableCell> cells;
    line.split(separator, cells);
    return cells;
}

/// "Pos X [mm]", "Pos X (mm)", "pos_x / mm" -> name and unit.
TextColumn column_of(const records::TableCell& cell) {
    std::string text = cell.plain();
    for (const auto& [open, close] : {std::pair{'[', ']'}, std::pair{'(', ')'}}) {
        const std::size_t at = text.find(open), end = text.find(close, at + 1);
        if (at == std::string::npos || end == std::string::npos) continue;
        const std::string unit(records::without_blanks(text.substr(at + 1, end - at - 1)));
        if (open == '(' && !find_unit(unit)) continue;  // a remark
        text.erase(at, end - at + 1);
        return {std::string(records::without_blanks(text)), unit, cell.column};
    }
    const std::size_t cut = text.find_last_of("_/ ");
    if (cut != std::string::npos && cut > 0) {
        const std::string unit(records::without_blanks(text.substr(cut + 1)));
        // "x_m" may be an axis; "time_s", "err um" and "angle / deg" are units.
        if (find_unit(unit)) {
            std::string name(records::without_blanks(text.substr(0, cut)));
            while (name.ends_with('/') || name.ends_with('_')) name.pop_back();
            return {std::string(records::without_blanks(name)), unit, cell.column};
        }
    }
    return {text, "", cell.column};
}

}  // namespace

TextTable::TextTable(std::string_view text, std::string path) : path_(std::move(path)) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
        throw InputError("text in UTF-16: save it as UTF-8", {path_, 1, 1});
    take_lines(text);
    choose_dialect();
    const std::size_t header = find_header();
    read_head(header);
    read_header(header);
    rows_.erase(rows_.begin(), rows_.begin() + static_cast<std::ptrdiff_t>(header) + 1);
    read_units();
    if (rows_.empty()) throw InputError("the table has no rows", {path_, header_.number, 1});
}

void TextTable::take_lines(std::string_view text) {
    for (int number = 1; !text.empty(); ++number) {
        const std::string_view line = records::take_line(text);
        if (!records::without_blanks(line).empty()) rows_.push_back({line, number});
    }
    if (rows_.empty()) throw InputError("the file is empty", {path_, 1, 1});
}

/// The separator that splits most lines alike, in this order where several do.
void TextTable::choose_dialect() {
    const std::size_t n = std::min(rows_.size(), sample_lines);
    const auto count = [&](std::string_view text, char c) {
        return std::count(text.begin(), text.end(), c);
    };
    std::size_t best = 0;
    separator_ = ' ';
    for (const char candidate : {'\t', ';', ',', '|'}) {
        std::map<std::ptrdiff_t, std::size_t> lines;
        for (std::size_t i = 0; i < n; ++i)
            if (const auto k = count(rows_[i].text, candidate); k > 0) ++lines[k];
        std::size_t alike = 0;
        for (const auto& [cells, number] : lines) alike = std::max(alike, number);
        if (candidate == ',' && best > 0) break;  // commas beside ; or tabs are decimal marks
        if (2 * alike <= n || alike <= best) continue;
        best = alike;
        separator_ = candidate;
    }
    if (separator_ == ',') return;
    for (std::size_t i = 0; i < n && !decimal_comma_; ++i)
        if (rows_[i].text[0] != '#') decimal_comma_ = has_decimal_comma(rows_[i].text);
    if (separator_ == ' ' && decimal_comma_ && best == 0 && n > 0 &&
        split_blanks(rows_[n - 1].text).size() == 1)
        throw InputError("a comma may be decimal mark or separator here: use ; between columns",
                         {path_, rows_[n - 1].number, 1}, std::string(rows_[n - 1].text));
}

bool TextTable::numbers_in(const Row& row) const {
    for (const records::TableCell& cell : cells_of({row.text, row.number, path_}, separator_))
        if (find_number(cell.text)) return true;
    return false;
}

/// The last line of words before the first line of numbers; a row of units between is none.
std::size_t TextTable::find_header() const {
    std::size_t width = 0, first = rows_.size();
    for (std::size_t i = std::min(rows_.size(), sample_lines); i-- > 0;)
        if (numbers_in(rows_[i]))
            width = std::max(width,
                             cells_of({rows_[i].text, rows_[i].number, path_}, separator_).size());
    for (std::size_t i = 0; i < std::min(rows_.size(), sample_lines); ++i) {
        if (rows_[i].text[0] == '#') continue;
        const records::TableLine line{rows_[i].text, rows_[i].number, path_};
        if (cells_of(line, separator_).size() == width) {
            first = i;
            break;
        }
    }
    if (first == rows_.size())
        throw InputError("no table: no line of numbers in the first 200", {path_, 1, 1});
    return first;
}

void TextTable::read_header(std::size_t at) {
    header_ = rows_[at];
    const auto cells = cells_of(header_line(), separator_);
    if (std::all_of(cells.begin(), cells.end(), [&](auto& c) { return find_number(c.text); }))
        header_line().fail("numbers where the names of the columns are expected", 1);
    for (const records::TableCell& cell : cells) columns_.push_back(column_of(cell));
}

/// A second line that holds units alone: "s;mm;mm".
void TextTable::read_units() {
    if (rows_.empty() || numbers_in(rows_.front())) return;
    const auto cells = cells_of(line(0), separator_);
    if (cells.size() != columns_.size()) return;
    for (std::size_t k = 0; k < cells.size(); ++k) {
        std::string unit = cells[k].plain();
        std::erase_if(unit, [](char c) { return c == '[' || c == ']' || c == '(' || c == ')'; });
        if (!unit.empty() && unit != "-" && !find_unit(unit)) return;
        if (find_unit(unit)) columns_[k].unit = unit;
    }
    rows_.erase(rows_.begin());
}

/// Lines above the table, "Feed: 1000" or "# plane = XY" or "Feed;1000".
void TextTable::read_head(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        std::string_view text = rows_[i].text;
        while (!text.empty() && (text[0] == '#' || text[0] == ' ')) text.remove_prefix(1);
        const std::size_t cut = text.find_first_of(":=;\t");
        if (cut == std::string_view::npos) continue;
        const std::string_view value = records::without_blanks(text.substr(cut + 1));
        head_[lower(records::without_blanks(text.substr(0, cut)))] =
            records::without_blanks(value.substr(0, value.find(';')));
    }
}

std::string TextTable::dialect_words() const {
    const std::string between = separator_ == '\t'  ? "tabs"
                                : separator_ == ' ' ? "blanks"
                                                    : std::string("'") + separator_ + '\'';
    return between + " between columns, decimal " + (decimal_comma_ ? "comma" : "point");
}

void TextTable::read(std::size_t i, std::vector<records::TableCell>& cells) const {
    if (separator_ == ' ')
        cells = split_blanks(rows_[i].text);
    else
        line(i).split(separator_, cells);
    if (cells.size() != columns_.size())
        line(i).fail("row has " + std::to_string(cells.size()) + " cells, the header " +
                         std::to_string(columns_.size()),
                     cells.size() < columns_.size() ? static_cast<int>(rows_[i].text.size()) + 1
                                                    : cells[columns_.size()].column);
}

std::optional<double> TextTable::find_number(std::string_view text) const {
    if (!decimal_comma_) return parse_number(text);
    if (text.find('.') != std::string_view::npos) return std::nullopt;
    if (text.find(',') == std::string_view::npos) return parse_number(text);
    std::string point(text);
    std::replace(point.begin(), point.end(), ',', '.');
    return parse_number(point);
}

double TextTable::number(std::size_t i, const records::TableCell& cell,
                         std::string_view what) const {
    if (const auto value = find_number(cell.text)) return *value;
    line(i).fail(std::string(what) + ": '" + std::string(cell.text) + "' is not a finite number" +
                     (decimal_comma_ ? " with a decimal comma, as the others here" : ""),
                 cell.column);
}

void TextTable::fail(std::size_t i, std::size_t column, const std::string& message) const {
    std::vector<records::TableCell> cells;
    read(i, cells);
    line(i).fail(message, cells[column].column);
}

}  // namespace trunnion::imports

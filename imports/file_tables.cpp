#include "imports/file_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/alarm.h"

namespace trunnion::imports {
namespace {

using Line = TextTable::Line;

/// Number of lines examined to determine the format.
constexpr std::size_t sample_lines = 200;

std::vector<Line> lines_of(std::string_view text) {
    std::vector<Line> lines;
    for (int number = 1; !text.empty(); ++number) {
        const std::string_view line = records::take_line(text);
        if (!records::without_blanks(line).empty()) lines.push_back({line, number});
    }
    return lines;
}

/// Lines that are not rows of told columns, although they have numbers.
bool has_numbers_above(const std::vector<Line>& lines, int first, const Dialect& dialect) {
    return std::any_of(lines.begin(), lines.end(), [&](const Line& line) {
        return line.number < first && line.text.front() != '#' &&
               has_number(cells_of({line.text, line.number, ""}, dialect.separator), dialect);
    });
}

}  // namespace

std::vector<TextTable> tables_of(std::string_view text, const std::string& path,
                                 const std::string& told, std::vector<std::string>& notes) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    return tables_of(lines_of(text), path, told, notes);
}

std::vector<TextTable> tables_of(const std::vector<Line>& lines, const std::string& path,
                                 const std::string& told, std::vector<std::string>& notes) {
    if (lines.empty()) throw InputError("the file is empty", {path, 1, 1});
    std::vector<records::TableLine> sample;
    for (std::size_t i = 0; i < std::min(lines.size(), sample_lines); ++i)
        sample.push_back({lines[i].text, lines[i].number, path});
    const Dialect dialect = dialect_of(sample);
    std::vector<TextTable> tables;
    for (std::size_t begin = 0; begin < lines.size(); begin = tables.back().end()) {
        TextTable table(lines, begin, path, dialect, told);
        if (table.size() == 0) {
            notes.push_back(fmt::format("{}: the lines from {} on, after the table, are not used",
                                        path, lines[begin].number));
            break;
        }
        const int first = table.header_line().number;
        if (!told.empty() && begin == 0 && has_numbers_above(lines, first, dialect))
            notes.push_back(fmt::format("{}: the rows begin at line {}", path, first));
        tables.push_back(std::move(table));
        if (tables.size() > 1) tables.back().inherit(tables[tables.size() - 2].head(), lines);
    }
    return tables;
}

std::vector<Line> MadeTable::lines() const {
    std::vector<Line> list;
    for (const OwnLine& line : lines_) list.push_back({line.text, line.number});
    return list;
}

}  // namespace trunnion::imports

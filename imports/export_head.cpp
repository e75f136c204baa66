#include "imports/export_head.h"

#include <algorithm>
#include <set>

#include "imports/columns.h"

namespace trunnion::imports {
namespace {

using Line = TextTable::Line;
using Cells = std::vector<records::TableCell>;

constexpr std::size_t most_properties = 40;  ///< lines between the names and the first row
constexpr std::size_t fewest_properties = 2;
constexpr std::size_t most_lines = 200;  ///< above the names

class Head {
  public:
    Head(const std::vector<Line>& lines, const Dialect& dialect)
        : lines_(lines), dialect_(dialect) {}

    std::string key(std::size_t i) const {
        const Cells row = cells(i);
        return row.empty() ? "" : plain_name(row.front().plain());
    }
    std::size_t width(std::size_t i) const { return cells(i).size(); }
    bool has_number(std::size_t i) const { return imports::has_number(cells(i), dialect_); }
    bool is_row(std::size_t i, std::size_t width) const {
        if (i >= lines_.size()) return false;
        const Cells row = cells(i);
        return row.size() == width && std::all_of(row.begin(), row.end(), [&](const auto& cell) {
                   return dialect_.find_number(cell.text).has_value();
               });
    }
    bool begins_with_number(std::size_t i) const {
        const Cells row = cells(i);
        return !row.empty() && dialect_.find_number(row.front().text);
    }

  private:
    Cells cells(std::size_t i) const {
        Cells row = cells_of({lines_[i].text, lines_[i].number, ""}, dialect_.separator);
        drop_empty_end(row);
        return row;
    }

    const std::vector<Line>& lines_;
    const Dialect& dialect_;
};

/// Rows behind the names in lines[at] and their properties; a line of units is no property.
std::optional<ExportHead> head_at(const Head& head, std::size_t at, std::size_t end) {
    static const std::set<std::string> unit_words{"unit", "units", "einheit", "engineeringunit"};
    const std::size_t width = head.width(at);
    if (head.key(at) != "name" || width < 2 || head.has_number(at)) return std::nullopt;
    ExportHead found{at, 0, {}};
    std::size_t properties = 0;
    for (std::size_t i = at + 1; i < end; ++i) {
        if (head.is_row(i, width) && head.is_row(i + 1, width)) {
            found.first_row = i;
            return properties >= fewest_properties ? std::optional(found) : std::nullopt;
        }
        if (head.begins_with_number(i)) return std::nullopt;
        properties += head.key(i).empty() ? 0 : 1;
        if (unit_words.contains(head.key(i))) found.units = i;
    }
    return std::nullopt;
}

}  // namespace

std::optional<ExportHead> find_export_head(const std::vector<Line>& lines, std::size_t begin,
                                           const Dialect& dialect) {
    const Head head(lines, dialect);
    for (std::size_t i = begin; i < std::min(lines.size(), begin + most_lines); ++i)
        if (const auto found = head_at(head, i, std::min(lines.size(), i + most_properties)))
            return found;
    return std::nullopt;
}

}  // namespace trunnion::imports

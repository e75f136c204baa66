#include "imports/column_names.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "imports/run_names.h"
#include "imports/units.h"

namespace trunnion::imports {
namespace {

using Cells = std::vector<records::TableCell>;

bool one_of(char c, std::string_view set) {
    return set.find(c) != std::string_view::npos;
}

/// "[3]" is an index, not a unit.
bool is_index(std::string_view text) {
    return text.find_first_not_of("0123456789") == std::string_view::npos;
}

/// Length of the path before every name: "Try/" of "Try/t", "Try/pos". It tells nothing.
std::size_t shared_path(const Cells& names) {
    const std::string first = names.front().plain();
    const std::size_t length = first.rfind('/') + 1;  // 0 without one
    const bool shared = std::all_of(names.begin(), names.end(), [&](const auto& cell) {
        const std::string name = cell.plain();
        return name.size() > length && name.starts_with(first.substr(0, length)) &&
               !find_unit(name.substr(length));
    });
    return shared && names.size() > 1 ? length : 0;
}

/// "[mm]", "" below the name of the targets.
bool is_unit_or_empty(const records::TableCell& cell) {
    std::string text = cell.plain();
    std::erase_if(text, [](char c) { return one_of(c, "[]()"); });
    return text.empty() || find_unit(text).has_value();
}

/// "[mm];+;-;+;-"; "-" alone is a missing value.
bool are_directions(const Cells& cells) {
    const auto missing = [](const auto& cell) { return cell.text == "-"; };
    return cells.size() > 1 && !std::all_of(cells.begin() + 1, cells.end(), missing) &&
           is_unit_or_empty(cells.front()) &&
           std::all_of(cells.begin() + 1, cells.end(), [](const auto& cell) {
               const RunName name = run_name(cell.plain());
               return name.direction != 0 && name.run == 0 && !name.other;
           });
}

}  // namespace

TextColumn column_named(const std::string& name, int column) {
    std::string text = name;
    for (const auto& [open, close] : {std::pair{'[', ']'}, std::pair{'(', ')'}}) {
        for (std::size_t at = 0; (at = text.find(open, at)) != std::string::npos; ++at) {
            const std::size_t end = text.find(close, at);
            if (end == std::string::npos) break;
            const std::string unit(records::without_blanks(text.substr(at + 1, end - at - 1)));
            if (!find_unit(unit) && (open == '(' || is_index(unit))) continue;  // a remark
            text.erase(at, end - at + 1);
            return {std::string(records::without_blanks(text)), unit, column};
        }
    }
    const std::size_t cut = text.find_last_of("_/ ,");
    if (cut != std::string::npos && cut > 0) {
        const std::string unit(records::without_blanks(text.substr(cut + 1)));
        // "x_m" may be an axis name; "time_s", "err um" and "angle / deg" contain units.
        if (find_unit(unit) && !is_index(unit.substr(0, 1))) {
            std::string left(records::without_blanks(text.substr(0, cut)));
            while (left.ends_with('/') || left.ends_with('_') || left.ends_with(','))
                left.pop_back();
            return {std::string(records::without_blanks(left)), unit, column};
        }
    }
    return {text, "", column};
}

std::vector<TextColumn> columns_named(const Cells& names) {
    const std::size_t path = shared_path(names);
    std::vector<TextColumn> columns;
    for (const records::TableCell& cell : names)
        columns.push_back(column_named(cell.plain().substr(path), cell.column));
    return columns;
}

bool join_names(const Cells& above, const Cells& below, std::vector<TextColumn>& columns) {
    if (!are_directions(below) || above.size() < 2 || above.size() > below.size() ||
        above.front().text.empty())
        return false;
    std::vector<TextColumn> joined;
    const records::TableCell* run = nullptr;
    for (std::size_t k = 0; k < below.size(); ++k) {
        if (k < above.size() && !above[k].text.empty()) run = &above[k];
        if (!run || (k > 0 && run_name(run->plain()).run == 0)) return false;
        const std::string name = run->plain() + ' ' + below[k].plain();
        joined.push_back(column_named(std::string(records::without_blanks(name)), run->column));
        if (k == 0) run = nullptr;
    }
    columns = std::move(joined);
    return true;
}

}  // namespace trunnion::imports

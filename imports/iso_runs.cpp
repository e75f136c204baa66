#include "imports/iso_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>

#include "base/alarm.h"
#include "imports/iso_columns.h"
#include "imports/side_columns.h"

namespace trunnion::imports {
namespace {

using Cells = std::vector<records::TableCell>;
using Runs = std::vector<RunColumn>;

/// +1 or -1: most steps of the targets from row to row go there.
int way_of_targets(const IsoSource& source) {
    int steps = 0;
    std::optional<double> last;
    Cells cells;
    for (std::size_t i = 0; i < source.table.size(); ++i) {
        source.table.read(i, cells);
        const auto target = source.table.find_number(cells[source.target].text);
        if (target && last) steps += *target > *last ? 1 : *target < *last ? -1 : 0;
        if (target) last = target;
    }
    return steps < 0 ? -1 : 1;
}

/// Direction of runs whose names have none.
int way_of_plain_runs(const IsoSource& source, std::vector<std::string>& notes) {
    if (source.way != 0) return source.way;
    if (!source.way_text.empty())
        source.table.header_line().fail(
            "the runs have no direction (\"1+\", \"1-\"), and '" + source.way_text +
                "' above the table is not one of them: --with sense=forward or backward tells it",
            1);
    const int way = way_of_targets(source);
    notes.push_back(source.table.path() + ": runs without a direction taken as " + by_order(way));
    return way;
}

/// The columns beside the targets by what their names tell.
struct Sorted {
    Runs runs, ways, plain;          ///< "1+"; "up"; "Run 1"
    std::vector<std::size_t> known;  ///< results, conditions, numbers of points
    std::vector<std::size_t> other;
};

void sort_column(const TextTable& table, std::size_t k, Sorted& sorted) {
    const TextColumn& column = table.columns()[k];
    const RunName name = run_name(column.name);
    const bool may_be_way = may_be_no_direction(column.name);  // "r": a result, or reverse
    const bool bare = name.run == 0 && name.direction == 0;
    const bool pass = name.run > 0 && name.direction != 0 && !name.other;
    const bool result = is_beside_runs(column) && (bare || name.other || is_result(column));
    if (!may_be_way && (result || (is_beside_values(column) && !pass)))
        sorted.known.push_back(k);
    else if (name.run > 0 && name.direction != 0)
        sorted.runs.push_back({k, name});
    else if (name.direction != 0 && !name.other)
        sorted.ways.push_back({k, name});
    else if (name.run > 0 && !name.other)
        sorted.plain.push_back({k, name});
    else
        sorted.other.push_back(k);
}

/// "Forward;Reverse;Forward;Reverse": the second one of a direction is the second run.
void number_ways(Runs& ways) {
    std::map<int, int> count;
    for (RunColumn& way : ways) way.name.run = ++count[way.name.direction];
}

void leave_over(const IsoSource& source, const Runs& list, Sorted& sorted) {
    for (const RunColumn& run : list) {
        const bool doubtful = may_be_no_direction(source.table.columns()[run.column].name);
        (doubtful ? sorted.known : sorted.other).push_back(run.column);
    }
}

/// The runs; what is none of them goes to `known` and `other`.
Runs chosen_runs(const IsoSource& source, Sorted& sorted, std::vector<std::string>& notes) {
    const TextTable& table = source.table;
    // A lone "r" beside a column of values is no pass.
    if (sorted.ways.size() == 1 &&
        may_be_no_direction(table.columns()[sorted.ways[0].column].name) &&
        (!sorted.plain.empty() || find_value_column(table, source.target))) {
        leave_over(source, sorted.ways, sorted);
        sorted.ways.clear();
    }
    Runs runs = sorted.runs;
    if (runs.empty()) {
        number_ways(sorted.ways);
        runs = std::exchange(sorted.ways, {});
    }
    if (runs.empty() && !sorted.plain.empty()) {
        runs = std::exchange(sorted.plain, {});
        const int way = way_of_plain_runs(source, notes);
        for (RunColumn& run : runs) run.name.direction = way;
    }
    leave_over(source, sorted.ways, sorted);
    leave_over(source, sorted.plain, sorted);
    return runs;
}

/// A column of numbers that is neither a run nor known to hold no readings ends the import.
void refuse_other(const IsoSource& source, const Sorted& sorted) {
    const TextTable& table = source.table;
    for (const std::size_t k : sorted.other) {
        const TextColumn& column = table.columns()[k];
        if (!table.has_numbers(k) || has_role_of_target(column)) continue;
        table.header_line().fail(
            fmt::format("'{}' beside the runs is not understood, and its readings would be lost. A "
                        "run has a number and a direction: {}. Results (mean, sigma ..) are left "
                        "out; so is what --with columns= names 'skip'",
                        column.name, accepted_directions),
            column.column);
    }
}

void refuse_doubtful(const IsoSource& source, const Runs& runs) {
    const TextTable& table = source.table;
    const bool up = std::any_of(runs.begin(), runs.end(),
                                [](const RunColumn& run) { return run.name.direction > 0; });
    for (std::size_t k = 0; k < runs.size(); ++k) {
        const TextColumn& column = table.columns()[runs[k].column];
        if (runs[k].name.lone_r && !up && source.way == 0)
            table.header_line().fail(
                "'" + column.name +
                    "' may be a run or the reverse of one: --with sense=forward or backward tells "
                    "the direction, or '1+' and '1-' do",
                column.column);
        const auto same = std::find_if(runs.begin(), runs.end(), [&](const RunColumn& other) {
            return other.name.run == runs[k].name.run &&
                   other.name.direction == runs[k].name.direction;
        });
        if (same->column != runs[k].column)
            table.header_line().fail("'" + column.name + "' and '" +
                                         table.columns()[same->column].name +
                                         "' are the same run in the same direction",
                                     column.column);
    }
}

void note_left_out(const IsoSource& source, const Sorted& sorted, std::vector<std::string>& notes) {
    const TextTable& table = source.table;
    std::vector<std::size_t> columns = sorted.known;
    columns.insert(columns.end(), sorted.other.begin(), sorted.other.end());
    std::sort(columns.begin(), columns.end());
    std::vector<std::string> names;
    for (const std::size_t k : columns)
        if (!table.columns()[k].name.empty()) names.push_back(table.columns()[k].name);
    if (!names.empty())
        notes.push_back(
            fmt::format("{}: beside the runs, not read: {}", table.path(), quoted(names)));
}

}  // namespace

std::string by_order(int way) {
    return std::string("towards ") + (way > 0 ? '+' : '-') + ", by the order of the targets";
}

bool before(const RunName& a, const RunName& b) {
    return std::pair(a.run, -a.direction) < std::pair(b.run, -b.direction);
}

int way_of(const IsoSource& source, const std::string& name, int direction) {
    if (source.heading_line == 0 && source.way != 0 && direction != 0 && direction != source.way)
        source.table.header_line().fail("'" + name + "' contradicts the direction '" +
                                            source.way_text + "' told for this table",
                                        1);
    return direction != 0 ? direction : source.way;
}

Runs run_columns(const IsoSource& source, std::vector<std::string>& notes) {
    const std::vector<TextColumn>& columns = source.table.columns();
    Sorted sorted;
    for (std::size_t k = 0; k < columns.size(); ++k)
        if (k != source.target) sort_column(source.table, k, sorted);
    Runs runs = chosen_runs(source, sorted, notes);
    if (runs.empty()) return runs;
    refuse_other(source, sorted);
    refuse_doubtful(source, runs);
    note_left_out(source, sorted, notes);
    for (const RunColumn& run : runs) way_of(source, columns[run.column].name, run.name.direction);
    // "1-, 1+, 2-" stand in the order in which they were measured; "1+, 2+, 1-, 2-" do not.
    const bool in_order =
        std::is_sorted(runs.begin(), runs.end(),
                       [](const auto& a, const auto& b) { return a.name.run < b.name.run; });
    if (!in_order)
        std::stable_sort(runs.begin(), runs.end(),
                         [](const auto& a, const auto& b) { return before(a.name, b.name); });
    return runs;
}

bool ResultRows::is_run(std::size_t k) const {
    return std::any_of(runs_.begin(), runs_.end(),
                       [&](const RunColumn& run) { return run.column == k; });
}

bool ResultRows::skips(std::size_t i, const Cells& cells) {
    const TextTable& table = source_.table;
    const auto is_name = [&](const records::TableCell& cell) {
        return !is_missing(cell.text) && !table.find_number(cell.text);
    };
    const records::TableCell* name = &cells[source_.target];
    if (table.find_number(name->text)) return false;
    for (std::size_t k = 0; k < cells.size() && !is_name(*name); ++k)
        if (!is_run(k) && is_name(cells[k])) name = &cells[k];
    const bool empty = std::all_of(runs_.begin(), runs_.end(), [&](const RunColumn& run) {
        return is_missing(cells[run.column].text);
    });
    if (!is_name(*name)) return empty;  // reading the target tells the fault
    const std::string text = name->plain();
    if (!is_result_row_name(text) && !empty) {
        if (std::string_view("+-.0123456789").find(text.front()) != std::string_view::npos)
            return false;  // a number with a slip or a unit: reading the target tells it
        table.line(i).fail(
            "'" + text + "' is no target, and no name of a row of results (mean, 2s)",
            name->column);
    }
    names_.push_back(text);
    return true;
}

std::string quoted(const std::vector<std::string>& names) {
    return fmt::format("'{}'", fmt::join(names, "', '"));
}

}  // namespace trunnion::imports

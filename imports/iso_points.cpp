#include "imports/iso_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "base/alarm.h"
#include "imports/iso_columns.h"
#include "imports/iso_values.h"
#include "imports/pass_order.h"
#include "imports/run_names.h"
#include "imports/time_column.h"
#include "imports/told_direction.h"

namespace trunnion::imports {
namespace {

using Cells = std::vector<records::TableCell>;

std::string word_before(const std::string& name) {
    return name.substr(0, name.find_first_of("0123456789"));
}

/// Sorts a pass by its direction: a file has its targets rising or falling. A length that does both
/// is a slip of the pen; an angle may pass zero.
void sort_pass(const IsoSource& source, std::vector<IsoPoint>& pass) {
    double trend = 0.0;
    for (std::size_t k = 1; k < pass.size(); ++k) {
        const double step = pass[k].target - pass[k - 1].target;
        if (source.quantities.target != Quantity::angle && step * trend < 0.0)
            source.table.fail(pass[k].row, 0, "targets out of order: they rise and fall");
        if (trend == 0.0) trend = step;
    }
    std::stable_sort(pass.begin(), pass.end(), [](const IsoPoint& a, const IsoPoint& b) {
        return a.direction > 0 ? a.target < b.target : a.target > b.target;
    });
}

/// In measured order: run 1 up, run 1 down, run 2 up ...
bool before(const RunName& a, const RunName& b) {
    return std::pair(a.run, -a.direction) < std::pair(b.run, -b.direction);
}

/// Direction of a pass whose name is `name`. One told above the table must not contradict it; for a
/// heading see take_directions().
int way_of(const IsoSource& source, const std::string& name, int direction) {
    if (source.heading_line == 0 && source.way != 0 && direction != 0 && direction != source.way)
        source.table.header_line().fail("'" + name + "' contradicts the direction '" +
                                            source.way_text + "' told for this table",
                                        1);
    return direction != 0 ? direction : source.way;
}

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

std::string by_order(int way) {
    return std::string("towards ") + (way > 0 ? '+' : '-') + ", by the order of the targets";
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

struct RunColumn {
    std::size_t column = 0;
    RunName name;
};

std::vector<RunColumn> run_columns(const IsoSource& source, std::vector<std::string>& notes) {
    std::vector<RunColumn> runs, ways, plain;
    const std::vector<TextColumn>& columns = source.table.columns();
    for (std::size_t k = 0; k < columns.size(); ++k) {
        if (k == source.target) continue;
        const RunName name = run_name(columns[k].name);
        if (name.run > 0 && name.direction != 0) runs.push_back({k, name});
        if (name.run == 0 && name.direction != 0 && !name.other)
            ways.push_back({k, {1, name.direction, false}});
        if (name.run > 0 && name.direction == 0 && !name.other)
            plain.push_back({k, {name.run, 0, false}});
    }
    // A lone "r" beside a column of values is no pass.
    if (ways.size() == 1 && may_be_no_direction(columns[ways[0].column].name) &&
        find_value_column(source.table, source.target))
        ways.clear();
    if (runs.empty()) runs = ways;
    if (runs.empty() && !plain.empty()) {
        runs = plain;
        const int way = way_of_plain_runs(source, notes);
        for (RunColumn& run : runs) run.name.direction = way;
    }
    for (const RunColumn& run : runs) way_of(source, columns[run.column].name, run.name.direction);
    std::stable_sort(runs.begin(), runs.end(),
                     [](const auto& a, const auto& b) { return before(a.name, b.name); });
    return runs;
}

/// "Mean" or "2 s" below the targets: results, not targets.
bool is_result_row(const IsoSource& source, const Cells& cells) {
    const std::string_view text = cells[source.target].text;
    return !text.empty() && !source.table.find_number(text) &&
           std::isalpha(static_cast<unsigned char>(text.front())) != 0;
}

/// Columns next to the targets, one for each run and direction.
std::vector<IsoPoint> matrix_points(const IsoSource& source, const std::vector<RunColumn>& runs) {
    std::vector<IsoPoint> points;
    Cells cells;
    for (const RunColumn& run : runs) {
        const double factor = value_factor(source, run.column);
        std::vector<IsoPoint> pass;
        for (std::size_t i = 0; i < source.table.size(); ++i) {
            source.table.read(i, cells);
            if (is_missing(cells[run.column].text) || is_result_row(source, cells)) continue;
            pass.push_back({number_in(source.table, i, cells, {source.target, source.factor}),
                            number_in(source.table, i, cells, {run.column, factor}), 0.0,
                            run.name.run, run.name.direction, i, 0});
        }
        sort_pass(source, pass);
        points.insert(points.end(), pass.begin(), pass.end());
    }
    step_times(source.facts, points);
    return points;
}

std::vector<IsoPoint> across_points(const IsoSource& source) {
    const auto& [table, facts, quantities, target, factor, way, way_text, heading] = source;
    const std::string& told = table.columns()[0].unit;
    const auto unit = find_unit(told.empty() ? usual_unit(quantities.target) : told);
    const auto value_unit = find_unit(facts.text("unit"));
    if (!value_unit || value_unit->quantity != quantities.value)
        table.header_line().fail("the unit of the deviations is not told: --with unit=um", 1);
    std::vector<std::pair<RunName, std::vector<IsoPoint>>> passes;
    Cells cells;
    for (std::size_t i = 0; i < table.size(); ++i) {
        table.read(i, cells);
        RunName name = run_name(cells[0].plain());
        name.direction = way_of(source, cells[0].plain(), name.direction);
        if (name.run == 0 || name.direction == 0) {
            if (name.other) continue;  // "mean up"
            table.line(i).fail("run and direction expected here: '1+', 'Run 2 down'", 1);
        }
        std::vector<IsoPoint> pass;
        for (std::size_t k = 1; k < cells.size(); ++k)
            if (!is_missing(cells[k].text))
                pass.push_back({table.find_number(table.columns()[k].name).value_or(0.0) *
                                    (unit ? unit->factor : 1.0),
                                number_in(table, i, cells, {k, value_unit->factor}), 0.0, name.run,
                                name.direction, i, 0});
        sort_pass(source, pass);
        passes.emplace_back(name, std::move(pass));
    }
    std::stable_sort(passes.begin(), passes.end(),
                     [](const auto& a, const auto& b) { return before(a.first, b.first); });
    std::vector<IsoPoint> points;
    for (const auto& [name, pass] : passes) points.insert(points.end(), pass.begin(), pass.end());
    refuse_numbers_of_targets(source, points, unit ? unit->factor : 1.0, value_unit->factor);
    step_times(facts, points);
    return points;
}

/// Columns of a list with one value a line.
struct ListColumns {
    NumberColumn value;
    std::optional<std::size_t> run, direction, axis;
};

ListColumns list_columns(const IsoSource& source, std::vector<std::string>& notes) {
    const TextTable& table = source.table;
    const auto value = find_value_column(table, source.target);
    if (!value)
        table.header_line().fail("no column of deviations and no columns of runs (\"1+\", \"1-\")",
                                 1);
    note_other_values(table, source.target, *value, notes);
    ListColumns columns{{*value, value_factor(source, *value)}, {}, {}, {}};
    columns.run = find_column(table, {"run", "cycle", "lauf", "zyklus", "repeat", "wiederholung",
                                      "series", "i", "jcycle"});
    columns.direction = find_column(table, {"direction", "dir", "richtung", "sense", "approach"});
    columns.axis = find_column(table, {"axis", "achse", "axisname"});
    return columns;
}

IsoPoint list_point(const IsoSource& source, const ListColumns& columns, std::size_t i,
                    const Cells& cells) {
    const TextTable& table = source.table;
    IsoPoint point{number_in(table, i, cells, {source.target, source.factor}),
                   number_in(table, i, cells, columns.value),
                   0.0,
                   0,
                   0,
                   i,
                   0};
    if (columns.run) {
        const records::TableCell& cell = cells[*columns.run];
        const RunName name = run_name(cell.plain());
        point.run = name.run > 0 ? name.run : static_cast<int>(table.number(i, cell, "run"));
        if (name.direction != 0 && !word_before(cell.plain()).empty())
            point.direction = name.direction;
    }
    if (columns.direction) {
        point.direction = direction_of(cells[*columns.direction].plain());
        if (point.direction == 0)
            table.line(i).fail("direction is + or - (up, down, forward, reverse ...)",
                               cells[*columns.direction].column);
    }
    return point;
}

/// One value a line, with or without columns for run, direction and axis.
std::vector<IsoSeries> listed_series(const IsoSource& source, Imported& result) {
    const TextTable& table = source.table;
    const ListColumns columns = list_columns(source, result.notes);
    const TimeColumn time(table, source.facts);
    std::vector<IsoSeries> series;
    Cells cells;
    std::size_t missing = 0;
    for (std::size_t i = 0; i < table.size(); ++i) {
        table.read(i, cells);
        if (is_missing(cells[columns.value.index].text)) {
            ++missing;
            continue;
        }
        IsoPoint point = list_point(source, columns, i, cells);
        point.time_s = time.time_s(table, i, cells);
        const std::string axis = columns.axis ? cells[*columns.axis].plain() : "";
        auto at = std::find_if(series.begin(), series.end(),
                               [&](const IsoSeries& s) { return s.axis == axis; });
        if (at == series.end()) at = series.insert(at, {axis, {}, time.dated(), time.is_told()});
        at->points.push_back(point);
    }
    if (!time.invented()) result.notes.push_back(table.path() + ": " + time.words());
    time.note_unit(table, result.notes);
    if (missing > 0)
        result.notes.push_back(fmt::format("{}: {} line{} without a value", table.path(), missing,
                                           missing > 1 ? "s" : ""));
    return series;
}

bool goes(const std::vector<IsoPoint>& points, int direction) {
    return std::any_of(points.begin(), points.end(),
                       [&](const IsoPoint& p) { return p.direction == direction; });
}

/// Directions of points without one, and a note on what determined them. A heading is not that of a
/// table whose names tell both directions.
void take_directions(const IsoSource& source, std::vector<IsoPoint>& points,
                     std::vector<std::string>& notes) {
    const TextTable& table = source.table;
    const bool up = goes(points, 1), down = goes(points, -1), heading = source.heading_line > 0;
    const int way = heading && up && down ? 0 : source.way;
    follow_order(table, points, way);
    for (const IsoPoint& p : points)
        if (way != 0 && p.direction != way)
            table.fail(
                p.row, 0,
                "this contradicts the direction '" + source.way_text + "' told for this table");
    if (way != 0 && heading)
        notes.push_back(fmt::format("{}: the heading of line {} tells the direction: {}",
                                    table.path(), source.heading_line, source.way_text));
    if (way == 0 && !up && !down && goes(points, 1) != goes(points, -1))
        notes.push_back(table.path() +
                        ": no direction is told: " + by_order(points.front().direction));
}

void finish(const IsoSource& source, IsoSeries& series, Imported& result) {
    const TextTable& table = source.table;
    std::vector<IsoPoint>& points = series.points;
    if (points.empty()) throw InputError("no value in the table", {table.path(), 1, 1});
    if (source.quantities.target == Quantity::angle) unwrap_turns(points);
    take_directions(source, points, result.notes);
    if (!series.timed && turn_passes(points))
        result.notes.push_back(table.path() +
                               ": passes listed against their direction are read in reverse");
    check_order(table, points);
    for (IsoPoint& p : points) p.line = table.line(p.row).number;
    if (!series.timed && !source.facts.has("step_s"))
        result.notes.push_back(table.path() + ": no times: rows one minute apart");
}

/// The direction that --with sense=, or a line above the table, tells. A heading ("Data backward
/// direction") completes a line such as "Direction: bidirectional" of the whole file.
void take_way(IsoSource& source) {
    source.way_text = source.facts.text("sense");
    source.way = direction_in(source.way_text).value_or(0);
    const auto heading = source.table.head().find("heading direction");
    if (heading == source.table.head().end()) return;
    const auto& [text, line] = heading->second;
    const int way = direction_in(text).value_or(0);
    if (way == 0 && source.way != 0) return;
    if (source.way * way < 0)
        source.table.head_line(heading->second)
            .fail("'" + text + "' contradicts the direction '" + source.way_text +
                      "' told for this table",
                  1);
    source.way = way;
    source.way_text = text;
    source.heading_line = line.number;
}

}  // namespace

bool targets_across(const TextTable& table) {
    const auto number = [&](const TextColumn& c) { return table.find_number(c.name); };
    return table.columns().size() > 3 &&
           std::all_of(table.columns().begin() + 1, table.columns().end(), number);
}

void step_times(const Facts& facts, std::vector<IsoPoint>& points) {
    const double step_s = facts.positive("step_s").value_or(60.0);
    for (std::size_t k = 0; k < points.size(); ++k)
        points[k].time_s = step_s * static_cast<double>(k);
}

std::vector<IsoSeries> read_iso_points(const TextTable& table, const Facts& facts,
                                       const IsoQuantities& quantities, Imported& result) {
    std::vector<IsoSeries> list;
    IsoSource source{table, facts, quantities, 0, 1.0, 0, "", 0};
    take_way(source);
    if (targets_across(table)) {
        list.push_back({"", across_points(source), false, false});
    } else {
        const auto target = target_column(table);
        if (!target)
            table.header_line().fail(
                "no column of targets (\"target\", \"position\", \"soll\"); --with columns= names "
                "them in their order",
                1);
        source.target = *target;
        source.factor =
            number_column(table, *target, quantities.target, usual_unit(quantities.target)).factor;
        note_units(source, result.notes);
        const auto runs = run_columns(source, result.notes);
        if (runs.empty())
            list = listed_series(source, result);
        else
            list.push_back({"", matrix_points(source, runs), false, false});
    }
    for (IsoSeries& series : list) finish(source, series, result);
    return list;
}

}  // namespace trunnion::imports

#include "imports/iso_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/alarm.h"
#include "imports/iso_columns.h"
#include "imports/iso_runs.h"
#include "imports/iso_values.h"
#include "imports/missing_values.h"
#include "imports/pass_order.h"
#include "imports/run_names.h"
#include "imports/side_columns.h"
#include "imports/time_column.h"
#include "imports/told_direction.h"

namespace trunnion::imports {
namespace {

using Cells = std::vector<records::TableCell>;

void note_rows(const TextTable& table, const std::vector<std::string>& names,
               std::vector<std::string>& notes) {
    if (!names.empty())
        notes.push_back(
            fmt::format("{}: rows of results, not read: {}", table.path(), quoted(names)));
}

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

/// Columns next to the targets, one for each run and direction.
std::vector<IsoPoint> matrix_points(const IsoSource& source, const std::vector<RunColumn>& runs,
                                    std::vector<std::string>& notes) {
    const TextTable& table = source.table;
    ResultRows results(source, runs);
    std::vector<std::size_t> rows;
    Cells cells;
    for (std::size_t i = 0; i < table.size(); ++i) {
        table.read(i, cells);
        if (!results.skips(i, cells)) rows.push_back(i);
    }
    std::vector<IsoPoint> points;
    MissingValues missing;
    for (const RunColumn& run : runs) {
        const double factor = value_factor(source, run.column);
        std::vector<IsoPoint> pass;
        for (const std::size_t i : rows) {
            table.read(i, cells);
            const double target = number_in(table, i, cells, {source.target, source.factor});
            if (is_missing(cells[run.column].text))
                missing.add(table.line(i).number, table.columns()[run.column].name);
            else
                pass.push_back({target, number_in(table, i, cells, {run.column, factor}), 0.0,
                                run.name.run, run.name.direction, i, 0});
        }
        sort_pass(source, pass);
        points.insert(points.end(), pass.begin(), pass.end());
    }
    missing.note(table.path(), notes);
    note_rows(table, results.names(), notes);
    step_times(source.facts, points);
    return points;
}

/// The run and the direction of a row of values; `other` for a row of results. Without numbers the
/// second row of a direction is the second run.
RunName row_name(const IsoSource& source, std::size_t i, const records::TableCell& cell,
                 std::map<int, int>& unnumbered) {
    const std::string text = cell.plain();
    RunName name = run_name(text);
    const bool bare = name.run == 0 && name.direction == 0;
    if ((name.other || bare) && is_result_row_name(text)) {
        name.other = true;
        return name;
    }
    if (name.other)
        source.table.line(i).fail(
            std::string("run and direction expected here ('1+', 'Run 2 "
                        "down'), or a row of results (mean, 2s). Directions: ") +
                accepted_directions,
            1);
    if (name.run == 0 && name.direction != 0) name.run = ++unnumbered[name.direction];
    name.direction = way_of(source, text, name.direction);
    if (name.run == 0 || name.direction == 0)
        source.table.line(i).fail("run and direction expected here: '1+', 'Run 2 down'", 1);
    return name;
}

std::vector<IsoPoint> across_points(const IsoSource& source, std::vector<std::string>& notes) {
    const auto& [table, facts, quantities, target, factor, way, way_text, heading] = source;
    const std::string& told = table.columns()[0].unit;
    const auto unit = find_unit(told.empty() ? usual_unit(quantities.target) : told);
    const auto value_unit = find_unit(facts.text("unit"));
    if (!value_unit || value_unit->quantity != quantities.value)
        table.header_line().fail("the unit of the deviations is not told: --with unit=um", 1);
    std::vector<std::pair<RunName, std::vector<IsoPoint>>> passes;
    std::vector<std::string> results;
    std::map<int, int> unnumbered;
    MissingValues missing;
    Cells cells;
    for (std::size_t i = 0; i < table.size(); ++i) {
        table.read(i, cells);
        const RunName name = row_name(source, i, cells[0], unnumbered);
        if (name.other) {
            results.push_back(cells[0].plain());
            continue;
        }
        std::vector<IsoPoint> pass;
        for (std::size_t k = 1; k < cells.size(); ++k) {
            if (is_missing(cells[k].text))
                missing.add(table.line(i).number, table.columns()[k].name);
            else
                pass.push_back({table.find_number(table.columns()[k].name).value_or(0.0) *
                                    (unit ? unit->factor : 1.0),
                                number_in(table, i, cells, {k, value_unit->factor}), 0.0, name.run,
                                name.direction, i, 0});
        }
        sort_pass(source, pass);
        for (const auto& [other, points] : passes)
            if (other.run == name.run && other.direction == name.direction)
                table.line(i).fail("this run in this direction stands above already", 1);
        passes.emplace_back(name, std::move(pass));
    }
    std::stable_sort(passes.begin(), passes.end(),
                     [](const auto& a, const auto& b) { return before(a.first, b.first); });
    missing.note(table.path(), notes);
    note_rows(table, results, notes);
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

/// What of a list is used.
struct UsedColumns {
    std::size_t target;
    const ListColumns& columns;
    const TimeColumn& time;

    bool has(std::size_t k) const {
        return k == target || k == columns.value.index || columns.run == k ||
               columns.direction == k || columns.axis == k || time.is_column(k);
    }
};

void note_unused(const TextTable& table, const UsedColumns& used, std::vector<std::string>& notes) {
    std::vector<std::string> names;
    for (std::size_t k = 0; k < table.columns().size(); ++k)
        if (const TextColumn& column = table.columns()[k]; !used.has(k) && !may_be_value(column))
            names.push_back(column.name);
    if (!names.empty())
        notes.push_back(fmt::format("{}: not read: {}", table.path(), quoted(names)));
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
    note_unused(table, {source.target, columns, time}, result.notes);
    std::vector<IsoSeries> series;
    Cells cells;
    MissingValues missing;
    for (std::size_t i = 0; i < table.size(); ++i) {
        table.read(i, cells);
        if (is_missing(cells[columns.value.index].text)) {
            missing.add(table.line(i).number, "");
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
    missing.note(table.path(), result.notes);
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

/// A word among units: "in;foo;foo" below the names of the columns was taken for names.
[[noreturn]] void refuse_without_targets(const TextTable& table) {
    const std::vector<TextColumn>& columns = table.columns();
    const auto is_unit = [](const TextColumn& c) { return find_unit(c.name).has_value(); };
    const auto other = std::find_if_not(columns.begin(), columns.end(), is_unit);
    if (std::any_of(columns.begin(), columns.end(), is_unit) && other != columns.end())
        table.header_line().fail("'" + other->name +
                                     "' is no unit, but stands in a row of units (mm, um, nm, in, "
                                     "uin, deg, arcsec, urad ..)",
                                 other->column);
    table.header_line().fail(
        "no column of targets (\"target\", \"position\", \"soll\"); --with columns= names them in "
        "their order",
        1);
}

}  // namespace

bool targets_across(const TextTable& table) {
    // "+1;-1" are runs.
    const auto number = [&](const TextColumn& c) {
        return !c.name.starts_with('+') && table.find_number(c.name);
    };
    return table.columns().size() > 3 &&
           std::all_of(table.columns().begin() + 1, table.columns().end(), number);
}

void step_times(const Facts& facts, std::vector<IsoPoint>& points) {
    const double step_s = facts.positive("step_s", Quantity::time, "s").value_or(60.0);
    for (std::size_t k = 0; k < points.size(); ++k)
        points[k].time_s = step_s * static_cast<double>(k);
}

std::vector<IsoSeries> read_iso_points(const TextTable& table, const Facts& facts,
                                       const IsoQuantities& quantities, Imported& result) {
    std::vector<IsoSeries> list;
    IsoSource source{table, facts, quantities, 0, 1.0, 0, "", 0};
    take_way(source);
    if (targets_across(table)) {
        list.push_back({"", across_points(source, result.notes), false, false});
    } else {
        const auto target = target_column(table);
        if (!target) refuse_without_targets(table);
        source.target = *target;
        source.factor =
            number_column(table, *target, quantities.target, usual_unit(quantities.target)).factor;
        note_units(source, result.notes);
        const auto runs = run_columns(source, result.notes);
        if (runs.empty())
            list = listed_series(source, result);
        else
            list.push_back({"", matrix_points(source, runs, result.notes), false, false});
    }
    for (IsoSeries& series : list) finish(source, series, result);
    return list;
}

}  // namespace trunnion::imports

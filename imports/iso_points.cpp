#include "imports/iso_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numeric>

#include "base/alarm.h"
#include "base/numbers.h"
#include "base/units.h"
#include "imports/column_roles.h"
#include "imports/pass_order.h"
#include "imports/run_names.h"

namespace trunnion::imports {
namespace {

using Cells = std::vector<records::TableCell>;

/// A table and the known facts about its numbers.
struct Source {
    const TextTable& table;
    const Facts& facts;
    IsoQuantities quantities;
    std::size_t target = 0;  ///< column
    double factor = 1.0;     ///< of the targets, to mm or rad
};

std::string usual_unit(Quantity quantity) {
    return quantity == Quantity::angle ? "deg" : "mm";
}

/// "Soll-Pos.", "X target": by the words of the name, with an axis in it or without.
std::optional<std::size_t> column_of_role(const TextTable& table, Role wanted) {
    for (std::size_t k = 0; k < table.columns().size(); ++k)
        for (const char* axis : {"", " x"}) {
            const auto role = role_of(table.columns()[k].name + axis);
            if (role && role->role == wanted && role->rate == Rate::position) return k;
        }
    return std::nullopt;
}

std::optional<std::size_t> target_column(const TextTable& table) {
    const auto named = find_first_column(
        table, {{"target", "targetposition", "targetpos", "ziel", "zielposition", "zielpos"},
                {"nominal", "nominalposition", "soll", "sollposition", "sollwert", "nominalangle"},
                {"commanded", "command", "cmd", "commandedposition", "setpoint", "reference",
                 "referenceangle", "ref"},
                {"position", "pos", "positionmm", "angle", "winkel"},
                {"x", "y", "z", "a", "b", "c"}});
    return named ? named : column_of_role(table, Role::commanded);
}

std::string word_before(const std::string& name) {
    return name.substr(0, name.find_first_of("0123456789"));
}

double value_factor(const Source& source, std::size_t column) {
    return number_column(source.table, column, source.quantities.value, source.facts.text("unit"))
        .factor;
}

/// Values beside their targets, in one unit.
struct Beside {
    std::vector<double> targets, apart;  ///< apart: value - target

    bool positions() const {  ///< "100.003" at the target 100
        return sum(apart, 0.0) < 0.05 * sum(targets, 0.0);
    }
    bool displacements() const {  ///< "200.003" at the target 100: counted from another zero
        return spread(apart) < 0.05 * spread(targets);
    }
    /// What deviations do not do: change as much as the targets.
    bool as_far_as_targets(const std::vector<double>& values) const {
        return spread(targets) > 0.0 && spread(values) > 0.5 * spread(targets);
    }

  private:
    static double sum(const std::vector<double>& list, double from) {
        double total = 0.0;
        for (const double v : list) total += std::abs(v - from);
        return total;
    }
    static double spread(const std::vector<double>& list) {
        const double total = std::accumulate(list.begin(), list.end(), 0.0);
        return sum(list, total / static_cast<double>(std::max<std::size_t>(1, list.size())));
    }
};

/// Values are positions if the user says so, or if they follow the targets. Then subtracts the
/// targets; displacements are counted from the first reading.
void take_deviations(const Source& source, std::vector<IsoPoint>& points,
                     std::vector<std::string>& notes) {
    const bool angle = source.quantities.target == Quantity::angle;
    Beside beside;
    std::vector<double> values;
    for (const IsoPoint& p : points) {
        const double apart = p.deviation - p.target;
        beside.targets.push_back(p.target);
        beside.apart.push_back(angle ? std::remainder(apart, 2.0 * pi) : apart);
        values.push_back(p.deviation);
    }
    const std::string told = source.facts.text("values");
    const bool same = source.quantities.value == source.quantities.target;
    const bool positions = told.empty() ? same && beside.positions() : told == "positions";
    if (positions || (told.empty() && same && beside.displacements())) {
        const double zero = positions ? 0.0 : beside.apart.front();
        for (std::size_t k = 0; k < points.size(); ++k)
            points[k].deviation = values[k] = beside.apart[k] - zero;
        notes.push_back(source.table.path() +
                        (positions ? ": values are positions: deviation = value - target"
                                   : ": values are displacements: deviation = value - target, "
                                     "counted from the first reading"));
    }
    if (told != "deviations" && same && beside.as_far_as_targets(values))
        source.table.header_line().fail(
            "the values change as much as the targets: another column, unit or sign? "
            "--with values=deviations takes them as they are",
            1);
}

/// Sorts a pass by its direction: a file has its targets rising or falling. A length that does both
/// is a slip of the pen; an angle may pass zero.
void sort_pass(const Source& source, std::vector<IsoPoint>& pass) {
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

void step_times(const Facts& facts, std::vector<IsoPoint>& points) {
    const double step_s = facts.positive("step_s").value_or(60.0);
    for (std::size_t k = 0; k < points.size(); ++k)
        points[k].time_s = step_s * static_cast<double>(k);
}

/// In measured order: run 1 up, run 1 down, run 2 up ...
bool before(const RunName& a, const RunName& b) {
    return std::pair(a.run, -a.direction) < std::pair(b.run, -b.direction);
}

struct RunColumn {
    std::size_t column = 0;
    RunName name;
};

std::vector<RunColumn> run_columns(const TextTable& table, std::size_t target,
                                   std::vector<std::string>& notes) {
    std::vector<RunColumn> runs, ways, plain;
    for (std::size_t k = 0; k < table.columns().size(); ++k) {
        if (k == target) continue;
        RunName name = run_name(table.columns()[k].name);
        if (name.run > 0 && name.direction != 0) runs.push_back({k, name});
        if (name.run == 0 && name.direction != 0 && !name.other)
            ways.push_back({k, {1, name.direction, false}});
        if (name.run > 0 && name.direction == 0 && !name.other)
            plain.push_back({k, {name.run, 1, false}});
    }
    if (runs.empty()) runs = ways;
    if (runs.empty() && !plain.empty()) {
        runs = plain;
        notes.push_back(table.path() + ": runs without a direction taken as towards +");
    }
    std::stable_sort(runs.begin(), runs.end(),
                     [](const auto& a, const auto& b) { return before(a.name, b.name); });
    return runs;
}

/// "Mean" or "2 s" below the targets: results, not targets.
bool is_result_row(const Source& source, const Cells& cells) {
    const std::string_view text = cells[source.target].text;
    return !text.empty() && !source.table.find_number(text) &&
           std::isalpha(static_cast<unsigned char>(text.front())) != 0;
}

/// Columns next to the targets, one for each run and direction.
std::vector<IsoPoint> matrix_points(const Source& source, const std::vector<RunColumn>& runs) {
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
                            run.name.run, run.name.direction, i});
        }
        sort_pass(source, pass);
        points.insert(points.end(), pass.begin(), pass.end());
    }
    step_times(source.facts, points);
    return points;
}

/// "Position;0;100;200" above "Run 1 up;0,1;0,3;0,2".
bool targets_across(const TextTable& table) {
    const auto number = [&](const TextColumn& c) { return table.find_number(c.name); };
    return table.columns().size() > 3 &&
           std::all_of(table.columns().begin() + 1, table.columns().end(), number);
}

std::vector<IsoPoint> across_points(const Source& source) {
    const auto& [table, facts, quantities, target, factor] = source;
    const std::string& told = table.columns()[0].unit;
    const auto unit = find_unit(told.empty() ? usual_unit(quantities.target) : told);
    const auto value_unit = find_unit(facts.text("unit"));
    if (!value_unit || value_unit->quantity != quantities.value)
        table.header_line().fail("the unit of the deviations is not told: --with unit=um", 1);
    std::vector<std::pair<RunName, std::vector<IsoPoint>>> passes;
    Cells cells;
    for (std::size_t i = 0; i < table.size(); ++i) {
        table.read(i, cells);
        const RunName name = run_name(cells[0].plain());
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
                                name.direction, i});
        sort_pass(source, pass);
        passes.emplace_back(name, std::move(pass));
    }
    std::stable_sort(passes.begin(), passes.end(),
                     [](const auto& a, const auto& b) { return before(a.first, b.first); });
    std::vector<IsoPoint> points;
    for (const auto& [name, pass] : passes) points.insert(points.end(), pass.begin(), pass.end());
    step_times(facts, points);
    return points;
}

/// Columns of a list with one value a line.
struct ListColumns {
    NumberColumn value;
    std::optional<std::size_t> run, direction, axis;
};

/// A value without unit next to its target is a position, in the unit of the target.
double list_factor(const Source& source, std::size_t column) {
    const TextTable& table = source.table;
    if (!table.columns()[column].unit.empty() || source.facts.has("unit"))
        return value_factor(source, column);
    Beside beside;
    Cells cells;
    for (std::size_t i = 0; i < table.size(); ++i) {
        table.read(i, cells);
        const auto target = table.find_number(cells[source.target].text),
                   value = table.find_number(cells[column].text);
        if (!target || !value) continue;
        beside.targets.push_back(*target);
        beside.apart.push_back(*value - *target);
    }
    const bool follow = beside.positions() || beside.displacements();
    return follow ? source.factor : value_factor(source, column);
}

ListColumns list_columns(const Source& source) {
    const TextTable& table = source.table;
    auto value = find_first_column(
        table, {{"deviation", "error", "abweichung", "fehler", "dev", "err", "positionerror",
                 "positioningerror", "positiondeviation", "delta", "diff", "difference", "abw",
                 "deviations", "angularerror", "straightness", "pitch", "yaw", "roll"},
                {"measured", "actual", "ist", "istposition", "istwert", "messwert", "reading",
                 "measuredposition", "actualposition", "laser", "laserreading", "laserposition",
                 "interferometer", "encoder", "resolver", "measuredangle", "actualangle"},
                {"value", "data", "position", "pos"}});
    if (!value) value = column_of_role(table, Role::error);
    if (!value) value = column_of_role(table, Role::actual);
    if (!value || *value == source.target)
        table.header_line().fail("no column of deviations and no columns of runs (\"1+\", \"1-\")",
                                 1);
    ListColumns columns{{*value, list_factor(source, *value)}, {}, {}, {}};
    columns.run = find_column(
        table, {"run", "cycle", "lauf", "zyklus", "repeat", "wiederholung", "series", "i"});
    columns.direction = find_column(table, {"direction", "dir", "richtung", "sense", "approach"});
    columns.axis = find_column(table, {"axis", "achse", "axisname"});
    return columns;
}

IsoPoint list_point(const Source& source, const ListColumns& columns, std::size_t i,
                    const Cells& cells) {
    const TextTable& table = source.table;
    IsoPoint point{number_in(table, i, cells, {source.target, source.factor}),
                   number_in(table, i, cells, columns.value),
                   0.0,
                   0,
                   0,
                   i};
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
std::vector<IsoSeries> listed_series(const Source& source, Imported& result) {
    const TextTable& table = source.table;
    const ListColumns columns = list_columns(source);
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
        if (at == series.end()) at = series.insert(at, {axis, {}, time.dated()});
        at->points.push_back(point);
    }
    result.notes.push_back(table.path() + ": " + time.words());
    if (missing > 0)
        result.notes.push_back(fmt::format("{}: {} line{} without a value", table.path(), missing,
                                           missing > 1 ? "s" : ""));
    return series;
}

void finish(const Source& source, IsoSeries& series, Imported& result) {
    const TextTable& table = source.table;
    std::vector<IsoPoint>& points = series.points;
    if (points.empty()) throw InputError("no value in the table", {table.path(), 1, 1});
    if (source.quantities.target == Quantity::angle) unwrap_turns(points);
    take_deviations(source, points, result.notes);
    follow_order(table, points);
    check_order(table, points);
}

}  // namespace

std::vector<IsoSeries> read_iso_points(const TextTable& table, const Facts& facts,
                                       const IsoQuantities& quantities, Imported& result) {
    std::vector<IsoSeries> list;
    Source source{table, facts, quantities, 0, 1.0};
    if (targets_across(table)) {
        list.push_back({"", across_points(source), false});
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
        const auto runs = run_columns(table, *target, result.notes);
        if (runs.empty())
            list = listed_series(source, result);
        else
            list.push_back({"", matrix_points(source, runs), false});
    }
    for (IsoSeries& series : list) finish(source, series, result);
    return list;
}

}  // namespace trunnion::imports

// A laser's or autocollimator's table of ISO 230-2: targets, runs and directions of one axis.
#include "records/iso230_2.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/alarm.h"
#include "base/numbers.h"
#include "base/units.h"
#include "imports/row_writer.h"

namespace trunnion::imports {
namespace {

constexpr double overrun_mm = 1.0;  ///< before the first target of a run; a row without a device
const double overrun_rad = rad_from_deg(1.0);

/// One value of the table. `target` and `deviation` in mm or rad.
struct Point {
    double target = 0.0, deviation = 0.0, time_s = 0.0;
    int run = 0;
    int direction = 0;  ///< +1 towards larger positions, -1, 0: not told
    std::size_t row = 0;
};

struct Layout {
    Axis axis = Axis::X;
    std::size_t target = 0;  ///< column
    double factor = 1.0;     ///< of the targets, to mm or rad
    double value_factor = 1.0;
    bool measured = false;  ///< values are positions, not deviations
    std::string words;
};

/// Run and direction in a column's name: "1+", "Run 2 up", "3 rueck", "up1", "2-".
struct RunName {
    int run = 0, direction = 0;
};

int direction_of(std::string word) {
    static const std::map<std::string, int> words{{"+", 1},
                                                  {"-", -1},
                                                  {"up", 1},
                                                  {"down", -1},
                                                  {"pos", 1},
                                                  {"neg", -1},
                                                  {"positive", 1},
                                                  {"negative", -1},
                                                  {"forward", 1},
                                                  {"reverse", -1},
                                                  {"backward", -1},
                                                  {"fwd", 1},
                                                  {"rev", -1},
                                                  {"bwd", -1},
                                                  {"vor", 1},
                                                  {"rueck", -1},
                                                  {"zurueck", -1},
                                                  {"hin", 1},
                                                  {"1", 1},
                                                  {"-1", -1},
                                                  {"+1", 1},
                                                  {"\xE2\x86\x91", 1},
                                                  {"\xE2\x86\x93", -1},
                                                  {"cw", -1},
                                                  {"ccw", 1}};
    std::transform(word.begin(), word.end(), word.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const auto it = words.find(word);
    return it == words.end() ? 0 : it->second;
}

/// Letters and signs of a column's name as the direction, digits as the run.
RunName run_name(const std::string& name) {
    RunName result;
    std::string word;
    const auto finish = [&] {
        if (const int direction = direction_of(word); direction != 0) result.direction = direction;
        word.clear();
    };
    for (const char c : name + ' ') {
        const bool digit = c >= '0' && c <= '9';
        if (digit) result.run = std::min(10 * result.run + (c - '0'), 100000);
        if (digit || c == ' ' || c == '_' || c == '.' || c == '#') {
            finish();
        } else if (c == '+' || c == '-') {
            finish();
            word = std::string(1, c);
            finish();
        } else {
            word += c;
        }
    }
    return result;
}

double value_factor(const TextTable& table, std::size_t column, Axis axis, const Facts& facts) {
    return number_column(table, column, is_rotary(axis) ? Quantity::angle : Quantity::length,
                         facts.text("unit"))
        .factor;
}

Axis axis_of_file(const TextTable& table, const setup::Setup& setup, const Facts& facts) {
    const std::string told = facts.text("axis");
    if (told.empty())
        throw InputError(
            "which axis was measured? --with axis=X, or a line 'Axis: X' above the "
            "table",
            {table.path(), 1, 1});
    const auto axis = axis_named(setup, told);
    if (!axis)
        throw InputError("the machine of " + setup.path + " has no axis '" + told + "'",
                         {table.path(), 1, 1});
    return *axis;
}

std::size_t target_column(const TextTable& table) {
    const auto named = find_column(
        table, {"target", "targetposition", "position", "pos", "nominal", "nominalposition", "soll",
                "sollposition", "ziel", "zielposition", "targetpos", "x", "y", "z", "a", "b", "c"});
    if (!named)
        table.header_line().fail("no column of targets (\"target\", \"position\", \"soll\")", 1);
    return *named;
}

/// Values are read as positions when that is said, or when they follow the targets.
bool holds_positions(const std::vector<Point>& points, const Facts& facts) {
    if (facts.has("values")) return facts.text("values") == "positions";
    double values = 0.0, apart = 0.0, targets = 0.0;
    for (const Point& p : points) {
        values += std::abs(p.deviation);
        apart += std::abs(p.deviation - p.target);
        targets += std::abs(p.target);
    }
    return targets > 0.0 && apart < 0.05 * targets && values > 0.5 * targets;
}

/// Columns beside the targets, one for each run and direction.
std::vector<Point> matrix_points(const TextTable& table, const Layout& layout, const Facts& facts,
                                 const std::vector<std::pair<std::size_t, RunName>>& runs) {
    std::vector<Point> points;
    std::vector<records::TableCell> cells;
    const double step_s = facts.positive("step_s").value_or(60.0);
    for (const auto& [column, name] : runs) {
        const double factor = value_factor(table, column, layout.axis, facts);
        std::vector<Point> pass;
        for (std::size_t i = 0; i < table.size(); ++i) {
            table.read(i, cells);
            if (cells[column].text.empty()) continue;
            pass.push_back({number_in(table, i, cells, {layout.target, layout.factor}),
                            number_in(table, i, cells, {column, factor}), 0.0, name.run,
                            name.direction, i});
        }
        std::stable_sort(pass.begin(), pass.end(), [&](const Point& a, const Point& b) {
            return name.direction > 0 ? a.target < b.target : a.target > b.target;
        });
        points.insert(points.end(), pass.begin(), pass.end());
    }
    for (std::size_t k = 0; k < points.size(); ++k)
        points[k].time_s = step_s * static_cast<double>(k);
    return points;
}

std::vector<std::pair<std::size_t, RunName>> run_columns(const TextTable& table,
                                                         std::size_t target) {
    std::vector<std::pair<std::size_t, RunName>> runs;
    for (std::size_t k = 0; k < table.columns().size(); ++k) {
        if (k == target) continue;
        const RunName name = run_name(table.columns()[k].name);
        if (name.run > 0 && name.direction != 0) runs.emplace_back(k, name);
    }
    // As measured: run 1 up, run 1 down, run 2 up ...
    std::stable_sort(runs.begin(), runs.end(), [](const auto& a, const auto& b) {
        return std::pair(a.second.run, -a.second.direction) <
               std::pair(b.second.run, -b.second.direction);
    });
    return runs;
}

/// One value a line, with or without columns of run and direction.
std::vector<Point> listed_points(const TextTable& table, const Layout& layout, const Facts& facts,
                                 Imported& result) {
    const auto value =
        find_column(table, {"deviation", "error", "abweichung", "fehler", "value", "measured",
                            "actual", "ist", "istposition", "messwert", "reading", "dev", "err",
                            "measuredposition", "actualposition", "laser"});
    if (!value)
        table.header_line().fail("no column of deviations and no columns of runs (\"1+\", \"1-\")",
                                 1);
    const auto run = find_column(
        table, {"run", "cycle", "lauf", "zyklus", "repeat", "wiederholung", "series", "i"});
    const auto direction =
        find_column(table, {"direction", "dir", "richtung", "sense", "approach"});
    const NumberColumn column{*value, value_factor(table, *value, layout.axis, facts)};
    const TimeColumn time(table, facts);
    std::vector<Point> points;
    std::vector<records::TableCell> cells;
    for (std::size_t i = 0; i < table.size(); ++i) {
        table.read(i, cells);
        Point point{number_in(table, i, cells, {layout.target, layout.factor}),
                    number_in(table, i, cells, column),
                    time.time_s(table, i, cells),
                    0,
                    0,
                    i};
        if (run) point.run = static_cast<int>(table.number(i, cells[*run], "run"));
        if (direction) {
            point.direction = direction_of(cells[*direction].plain());
            if (point.direction == 0)
                table.line(i).fail("direction is + or - (up, down, forward, reverse ...)",
                                   cells[*direction].column);
        }
        points.push_back(point);
    }
    result.notes.push_back(table.path() + ": " + time.words());
    return points;
}

/// Directions that no column tells follow from the order of the targets: a target that stands twice
/// in a row is the end of one pass and the begin of the next.
void follow_order(const TextTable& table, std::vector<Point>& points) {
    if (std::all_of(points.begin(), points.end(), [](auto& p) { return p.direction != 0; })) return;
    int direction = 0, run = 1;
    for (std::size_t k = 0; k < points.size(); ++k) {
        const std::size_t last = points.size() - 1;
        const double before = k > 0 ? points[k].target - points[k - 1].target : 0.0;
        const double after = k < last ? points[k + 1].target - points[k].target : 0.0;
        const double step = before != 0.0 ? before : after;
        const int now = step > 0.0 ? 1 : step < 0.0 ? -1 : 0;
        if (now == 0)
            table.fail(points[k].row, 0, "targets out of order: from which side was this one?");
        if (direction < 0 && now > 0) ++run;
        points[k].direction = direction = now;
        points[k].run = run;
    }
}

/// Within a pass the targets rise or fall as its direction says.
void check_order(const TextTable& table, const std::vector<Point>& points) {
    for (std::size_t k = 1; k < points.size(); ++k) {
        const Point &a = points[k - 1], &b = points[k];
        const bool same = a.run == b.run && a.direction == b.direction;
        if (same && (b.target - a.target) * b.direction < 0.0)
            table.fail(b.row, 0, "targets out of order within a run");
    }
}

/// ISO 841: what a positive command moves of the tool against the work, or turns.
Vector3 direction_M(const setup::Setup& setup, Axis axis) {
    const kinematics::Chain& chain = setup.machine.chain;
    const bool carries_work =
        std::any_of(chain.work.begin(), chain.work.end(), [&](auto& a) { return a.axis == axis; });
    return carries_work ? Vector3(-chain.find(axis)->direction) : chain.find(axis)->direction;
}

void write_points(const TextTable& table, const std::vector<Point>& points, records::Reading row,
                  Axis axis, RowWriter& rows) {
    const double overrun = is_rotary(axis) ? overrun_rad : overrun_mm;
    const records::Device device = row.device;
    for (std::size_t k = 0; k < points.size(); ++k) {
        const Point& p = points[k];
        const bool begins =
            k == 0 || points[k - 1].direction != p.direction || points[k - 1].run != p.run;
        row.time_s = p.time_s;
        if (begins) {
            records::Reading before = row;
            before.device = records::Device::none;
            before.angular = false;
            before.commanded[axis] = p.target - overrun * p.direction;
            before.time_s = k == 0 ? p.time_s - 1.0 : 0.5 * (points[k - 1].time_s + p.time_s);
            rows.add(std::move(before), 0);
        }
        row.device = device;
        row.commanded[axis] = p.target;
        row.value_mm = p.deviation;
        rows.add(row, table.line(p.row).number);
    }
}

int count_of(const std::vector<Point>& points, bool targets) {
    std::set<double> distinct;
    for (const Point& p : points) distinct.insert(targets ? p.target : double(p.run));
    return static_cast<int>(distinct.size());
}

Layout layout_of(const TextTable& table, const setup::Setup& setup, const Facts& facts) {
    Layout layout;
    layout.axis = axis_of_file(table, setup, facts);
    layout.target = target_column(table);
    const bool rotary = is_rotary(layout.axis);
    layout.factor = number_column(table, layout.target, rotary ? Quantity::angle : Quantity::length,
                                  rotary ? "deg" : "mm")
                        .factor;
    return layout;
}

std::vector<Point> read_points(const TextTable& table, const Layout& layout, const Facts& facts,
                               Imported& result) {
    const auto runs = run_columns(table, layout.target);
    std::vector<Point> points = runs.empty() ? listed_points(table, layout, facts, result)
                                             : matrix_points(table, layout, facts, runs);
    if (points.empty()) throw InputError("no value in the table", {table.path(), 1, 1});
    if (holds_positions(points, facts)) {
        for (Point& p : points) p.deviation -= p.target;
        result.notes.push_back(table.path() + ": values are positions: deviation = value - target");
    }
    follow_order(table, points);
    check_order(table, points);
    return points;
}

void tell(const TextTable& table, const std::vector<Point>& points, const Layout& layout,
          Imported& result) {
    const bool rotary = is_rotary(layout.axis);
    const bool both = std::any_of(points.begin(), points.end(),
                                  [&](auto& p) { return p.direction != points[0].direction; });
    result.summary.push_back(fmt::format("{}: {}, {} runs {} at {} targets, {}; {}", table.path(),
                                         letter_of(layout.axis), count_of(points, false),
                                         both ? "both ways" : "one way", count_of(points, true),
                                         rotary ? "deg" : "mm", table.dialect_words()));
    std::vector<records::DeviationPoint> list;
    for (const Point& p : points) list.push_back({p.target, p.direction, p.deviation});
    const records::Iso230Figures figures = records::iso230_2_figures(list);
    result.summary.push_back(records::iso230_2_words(figures, rotary));
}

}  // namespace

Imported import_iso230_2(const ImportRequest& request) {
    Imported result;
    RowWriter rows(request.setup, "iso230-2", {}, true, true);
    for (const ImportFile& file : request.files) {
        const TextTable table(file.text, file.path);
        const Facts facts = request.facts.with_head_of(table);
        const Layout layout = layout_of(table, request.setup, facts);
        const bool rotary = is_rotary(layout.axis);
        const auto points = read_points(table, layout, facts, result);
        records::Reading row;
        row.test = facts.text("test", std::string(1, letter_of(layout.axis)));
        row.device = rotary ? records::Device::angle : records::Device::linear;
        row.angular = rotary;
        row.feature =
            artefact_for(request.setup, facts.text("feature"), setup::Artefact::Kind::target).name;
        row.direction_M = direction_M(request.setup, layout.axis);
        row.commanded = positions_told(request.setup, facts.text("at"));
        rows.begin_file(table, facts);
        write_points(table, points, row, layout.axis, rows);
        tell(table, points, layout, result);
    }
    result.readings = rows.take();
    return result;
}

}  // namespace trunnion::imports

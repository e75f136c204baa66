#include "imports/point_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "imports/column_roles.h"

namespace trunnion::imports {
namespace {

using Cells = std::vector<records::TableCell>;

bool any(const ThreeColumns& columns) {
    return std::any_of(columns.begin(), columns.end(), [](auto& c) { return c.has_value(); });
}

std::optional<std::size_t> component_of(const std::string& letter) {
    const std::size_t d = std::string_view("XYZ").find(letter);
    return letter.size() == 1 && d != std::string_view::npos ? std::optional(d) : std::nullopt;
}

/// A coordinate name without further word ("x") is a measured one.
ThreeColumns& place_of(PointColumns& columns, Role role) {
    if (role == Role::commanded) return columns.nominal;
    return role == Role::error ? columns.error : columns.measured;
}

/// A table of points, and what is known about it.
struct PointTable {
    const TextTable& table;
    const setup::Setup& setup;
    const Facts& facts;
};

void take(const PointTable& source, std::size_t k, const ColumnRole& role, PointColumns& columns) {
    const auto& [table, setup, facts] = source;
    const TextColumn& column = table.columns()[k];
    const auto axis = axis_named(setup, role.axis);
    const std::string unit = facts.text("unit", "mm");
    const auto d = component_of(role.axis);
    if (role.machine || !d) {
        if (!axis) {
            columns.unused.push_back(column.name);
            return;
        }
        const bool rotary = turns(setup, *axis);
        columns.axes.emplace_back(
            *axis, number_column(table, k, rotary ? Quantity::angle : Quantity::length,
                                 rotary ? "deg" : unit));
        return;
    }
    auto& place = place_of(columns, role.role)[*d];
    if (place)
        table.header_line().fail(
            "a second column for this coordinate: its name must say which of them is nominal, "
            "measured or a deviation",
            column.column);
    place = number_column(table, k, Quantity::length, unit);
}

/// The unit of a deviation is never guessed. Beside nominal and measured it is not needed.
void refuse_guess(const PointTable& source, std::size_t k, const ColumnRole& role,
                  PointColumns& columns) {
    const auto d = component_of(role.axis);
    // Rotary axes alone do not tell where the target should be.
    const bool placed = std::any_of(columns.axes.begin(), columns.axes.end(),
                                    [&](const auto& a) { return !turns(source.setup, a.first); });
    const bool both = d && columns.measured[*d] && (columns.nominal[*d] || placed);
    if (d && !both) number_column(source.table, k, Quantity::length, "");
    columns.unused.push_back(source.table.columns()[k].name);
}

/// True for "X", "Y", "Z" (or "x-coordinate") in the cell of the first row.
bool names_coordinate(const TextTable& table, std::size_t column) {
    Cells cells;
    table.read(0, cells);
    const auto role = role_of(cells[column].plain());
    return role && component_of(role->axis);
}

/// One line for each coordinate: name, axis, nominal, actual, deviation.
bool take_lines(const TextTable& table, const Facts& facts, const TimeColumn& time,
                PointColumns& columns) {
    const auto coordinate =
        find_first_column(table, {{"coordinate", "coord", "koordinate"},
                                  {"axis", "achse", "ax"},
                                  {"characteristic", "merkmal", "dim", "dimension"}});
    const auto nominal = find_column(table, {"nominal", "nom", "soll", "sollwert", "nennwert"}),
               measured = find_column(
                   table, {"measured", "meas", "actual", "act", "ist", "istwert", "messwert"}),
               error = find_column(table, {"deviation", "dev", "abweichung", "error", "diff"});
    if (!coordinate || !names_coordinate(table, *coordinate) || (!measured && !error)) return false;
    columns.coordinate = coordinate;
    columns.name = find_first_column(table, {{"name", "label", "point", "punkt", "element"},
                                             {"feature", "id", "no", "nr", "number"}});
    const std::string unit = facts.text("unit", "mm");
    const auto place = [&](const std::optional<std::size_t>& column, const std::string& otherwise) {
        return column ? std::optional(number_column(table, *column, Quantity::length, otherwise))
                      : std::nullopt;
    };
    columns.nominal[0] = place(nominal, unit);
    columns.measured[0] = place(measured, unit);
    // A deviation beside both is not used; alone it must tell its unit.
    if (!nominal || !measured) columns.error[0] = place(error, facts.text("unit"));
    std::set<std::optional<std::size_t>> used{coordinate, columns.name, nominal,
                                              measured,   error,        columns.session};
    if (columns.sigma) used.insert(columns.sigma->index);
    for (std::size_t k = 0; k < table.columns().size(); ++k)
        if (!used.contains(k) && !time.is_column(k))
            columns.unused.push_back(table.columns()[k].name);
    return true;
}

void check(const TextTable& table, const PointColumns& columns) {
    const bool nominal = any(columns.nominal), error = any(columns.error);
    if (!any(columns.measured) && !(nominal && error))
        table.header_line().fail(
            "no columns of measured x, y and z; --with columns=\"n, x nominal, ..\" names them in "
            "their "
            "order",
            1);
    if (!nominal && !error && columns.axes.empty())
        table.header_line().fail(
            "no columns of nominal x, y and z, and none of axis positions (\"machine x\")", 1);
}

std::optional<double> number(const LineCells& line, const std::optional<NumberColumn>& column) {
    if (!column || is_missing(line.cells[column->index].text)) return std::nullopt;
    return number_in(line.table, line.row, line.cells, *column);
}

/// Computes nominal and measured from any two of nominal, measured and their difference.
void fill(const LineCells& line, const PointColumns& columns,
          std::pair<std::size_t, std::size_t> from_to, MeasuredPoint& point) {
    const auto [from, d] = from_to;
    auto nominal = number(line, columns.nominal[from]),
         measured = number(line, columns.measured[from]);
    const auto error = number(line, columns.error[from]);
    if (!nominal && measured && error) nominal = *measured - *error;
    if (!columns.measured[from] && nominal && error) measured = *nominal + *error;
    point.nominal[d] = nominal;
    point.measured[d] = measured;
    point.rows[d] = line.row;
}

}  // namespace

PointColumns point_columns(const TextTable& table, const setup::Setup& setup, const Facts& facts,
                           const TimeColumn& time) {
    PointColumns columns;
    columns.session = find_column(table, {"session", "setup", "tag", "day"});
    const auto sigma = sigma_column(table);
    if (sigma)
        columns.sigma = number_column(table, *sigma, Quantity::length, facts.text("unit", "mm"));
    if (take_lines(table, facts, time, columns)) return columns;
    columns.feature = find_column(table, {"feature", "artefact"});
    std::vector<std::pair<std::size_t, ColumnRole>> unit_open;
    for (std::size_t k = 0; k < table.columns().size(); ++k) {
        if (time.is_column(k) || columns.session == k || columns.feature == k || sigma == k)
            continue;
        const TextColumn& column = table.columns()[k];
        const auto role = role_of(column.name, setup.machine.chain.names());
        if (!role || role->rate != Rate::position || role->role == Role::following_error)
            columns.unused.push_back(column.name);
        else if (role->role == Role::error && column.unit.empty() && !facts.has("unit"))
            unit_open.emplace_back(k, *role);
        else
            take({table, setup, facts}, k, *role, columns);
    }
    for (const auto& [k, role] : unit_open) refuse_guess({table, setup, facts}, k, role, columns);
    check(table, columns);
    return columns;
}

namespace {

/// The point of a line that gives one coordinate: the last one of its name, wherever it stands; of
/// lines without names the one before, as long as it lacks the coordinate.
class PointsOfLines {
  public:
    explicit PointsOfLines(const TextTable& table) : table_(table) {}

    MeasuredPoint& of(std::size_t row, const std::string& name, std::size_t d) {
        const auto [last, is_first] = last_.try_emplace(name, points.size());
        if (is_first || filled_[last->second][d]) {
            if (name.empty() && !is_first) seen_again(row, d);
            last->second = points.size();
            points.push_back({row, {}, {}, {}});
            filled_.push_back({});
        }
        filled_[last->second][d] = true;
        return points[last->second];
    }
    /// Throws InputError where lines without names stand sorted by coordinate: nobody tells which
    /// of them are one point.
    void check() const {
        std::set<std::size_t> kinds;
        for (const auto& filled : filled_)
            for (std::size_t d = 0; d < 3; ++d)
                if (filled[d]) kinds.insert(d);
        if (alone_ && kinds.size() > 1)
            table_.fail(*alone_, 0,
                        "one coordinate follows itself, and other lines have the others: which "
                        "are one point? a column \"name\" tells (--with columns=)");
    }

    std::vector<MeasuredPoint> points;

  private:
    void seen_again(std::size_t row, std::size_t d) {
        const auto& before = filled_.back();
        if (std::count(before.begin(), before.end(), true) == 1 && before[d] && !alone_)
            alone_ = row;
    }

    const TextTable& table_;
    std::map<std::string, std::size_t> last_;  ///< last point of each name
    std::vector<std::array<bool, 3>> filled_;  ///< coordinates that a line gave
    std::optional<std::size_t> alone_;
};

std::vector<MeasuredPoint> points_of_lines(const TextTable& table, const PointColumns& columns,
                                           LeftOut& left_out) {
    PointsOfLines points(table);
    Cells cells;
    for (std::size_t i = 0; i < table.size(); ++i) {
        table.read(i, cells);
        const records::TableCell& cell = cells[*columns.coordinate];
        const auto role = role_of(cell.plain());
        const auto d = role ? component_of(role->axis) : std::nullopt;
        if (!d) {
            left_out.names.push_back(cell.plain());
            continue;
        }
        MeasuredPoint& point = points.of(i, columns.name ? cells[*columns.name].plain() : "", *d);
        fill({table, i, cells}, columns, {0, *d}, point);
        if (!point.measured[*d]) left_out.values.add(table.line(i).number, cell.plain());
    }
    points.check();
    return std::move(points.points);
}

}  // namespace

std::vector<MeasuredPoint> measured_points(const TextTable& table, const PointColumns& columns,
                                           LeftOut& left_out) {
    if (columns.coordinate) return points_of_lines(table, columns, left_out);
    std::vector<MeasuredPoint> points;
    Cells cells;
    for (std::size_t i = 0; i < table.size(); ++i) {
        table.read(i, cells);
        MeasuredPoint point{i, {}, {}, {}};
        for (std::size_t d = 0; d < 3; ++d) {
            fill({table, i, cells}, columns, {d, d}, point);
            const auto& column = columns.measured[d] ? columns.measured[d] : columns.error[d];
            if (column && !point.measured[d])
                left_out.values.add(table.line(i).number, table.columns()[column->index].name);
        }
        points.push_back(point);
    }
    return points;
}

void LeftOut::note(const std::string& path, std::vector<std::string>& notes) const {
    values.note(path, notes);
    const std::set<std::string> distinct(names.begin(), names.end());
    if (!distinct.empty())
        notes.push_back(fmt::format("{}: {} line{} of no coordinate not read: '{}'", path,
                                    names.size(), names.size() > 1 ? "s" : "",
                                    fmt::join(distinct, "', '")));
}

bool lacks_nominal(const PointColumns& columns, const MeasuredPoint& point) {
    for (std::size_t d = 0; d < 3; ++d) {
        const std::size_t k = columns.coordinate ? 0 : d;
        const bool told = columns.nominal[k] || (columns.measured[k] && columns.error[k]);
        const bool wanted = !columns.coordinate || point.measured[d];
        if (told && wanted && !point.nominal[d]) return true;
    }
    return false;
}

}  // namespace trunnion::imports

// A servo log: commanded and actual positions of one or more axes.
#include <fmt/format.h>

#include <algorithm>

#include "base/alarm.h"
#include "imports/column_roles.h"
#include "imports/row_writer.h"

namespace trunnion::imports {
namespace {

/// The columns of one axis.
struct AxisColumns {
    Axis axis = Axis::X;
    std::optional<NumberColumn> commanded, actual, error, velocity, acceleration;
    double error_sign = 1.0;

    bool read() const { return (commanded && actual) || (commanded && error); }
};

struct Log {
    std::vector<AxisColumns> axes;
    std::vector<std::string> unused;
    bool units_assumed = false;
};

Quantity quantity_of(Axis axis, Rate rate) {
    if (rate == Rate::acceleration) return Quantity::per_s2;
    if (rate == Rate::velocity) return is_rotary(axis) ? Quantity::turning : Quantity::speed;
    return is_rotary(axis) ? Quantity::angle : Quantity::length;
}

std::string usual_unit(Axis axis, Rate rate) {
    if (rate == Rate::acceleration) return "mm/s2";
    if (rate == Rate::velocity) return is_rotary(axis) ? "deg/s" : "mm/s";
    return is_rotary(axis) ? "deg" : "mm";
}

/// Whether the error is actual - commanded (+1) or commanded - actual.
double sign_of_error(const TextTable& table, const TextColumn& column, Role role,
                     const Facts& facts) {
    const std::string sign = facts.text("sign", role == Role::error ? "+" : "");
    if (sign != "+" && sign != "-")
        table.header_line().fail("'" + column.name +
                                     "': actual - commanded (--with sign=+) or commanded - actual "
                                     "(--with sign=-)?",
                                 column.column);
    return sign == "+" ? 1.0 : -1.0;
}

std::optional<NumberColumn>& place_of(AxisColumns& axis, const ColumnRole& role) {
    if (role.rate == Rate::velocity) return axis.velocity;
    if (role.rate == Rate::acceleration) return axis.acceleration;
    if (role.role == Role::commanded) return axis.commanded;
    return role.role == Role::actual ? axis.actual : axis.error;
}

/// Speeds that the encoder told are no commanded motion; a position is one of the two or the error.
bool wanted(const ColumnRole& role) {
    return role.rate == Rate::position ? role.role != Role::none : role.role != Role::actual;
}

AxisColumns& columns_of(Log& log, Axis axis) {
    for (AxisColumns& columns : log.axes)
        if (columns.axis == axis) return columns;
    log.axes.push_back({});
    log.axes.back().axis = axis;
    return log.axes.back();
}

/// A name without a letter ("commanded", "actual position") is about the axis that is told.
std::optional<ColumnRole> role_in(const TextColumn& column, const Facts& facts) {
    if (auto role = role_of(column.name)) return role;
    return facts.has("axis") ? role_of(column.name + ' ' + facts.text("axis")) : std::nullopt;
}

Log read_columns(const TextTable& table, const setup::Setup& setup, const Facts& facts,
                 const TimeColumn& time) {
    Log log;
    for (std::size_t k = 0; k < table.columns().size(); ++k) {
        if (time.column() == k) continue;
        const TextColumn& column = table.columns()[k];
        const auto role = role_in(column, facts);
        const auto axis = role ? axis_named(setup, std::string(1, role->axis)) : std::nullopt;
        if (!axis || !wanted(*role)) {
            log.unused.push_back(column.name);
            continue;
        }
        AxisColumns& columns = columns_of(log, *axis);
        std::optional<NumberColumn>& place = place_of(columns, *role);
        if (place) table.header_line().fail("a second column for this", column.column);
        log.units_assumed |= column.unit.empty() && !facts.has("unit");
        const bool rate = role->rate != Rate::position;
        place = number_column(table, k, quantity_of(*axis, role->rate),
                              rate ? usual_unit(*axis, role->rate)
                                   : facts.text("unit", usual_unit(*axis, role->rate)));
        if (&place == &columns.error)
            columns.error_sign = sign_of_error(table, column, role->role, facts);
    }
    return log;
}

void check(const TextTable& table, const Log& log) {
    if (std::none_of(log.axes.begin(), log.axes.end(), [](auto& axis) { return axis.read(); }))
        table.header_line().fail(
            "no axis has both a commanded and an actual position (\"X commanded\", \"X actual\")",
            1);
}

void write_row(const TextTable& table, std::size_t i, const std::vector<records::TableCell>& cells,
               const Log& log, records::Reading row, RowWriter& rows) {
    const auto number = [&](const std::optional<NumberColumn>& column) {
        return column ? std::optional(number_in(table, i, cells, *column)) : std::nullopt;
    };
    for (const AxisColumns& axis : log.axes)
        if (const auto q = number(axis.commanded)) row.commanded[axis.axis] = *q;
    row.device = records::Device::axis;
    for (const AxisColumns& axis : log.axes) {
        if (!axis.read()) continue;
        row.feature = std::string(1, letter_of(axis.axis));
        row.angular = is_rotary(axis.axis);
        row.value_mm = axis.actual ? *number(axis.actual) - row.commanded[axis.axis]
                                   : axis.error_sign * *number(axis.error);
        row.velocity_mm_s = number(axis.velocity);
        row.acceleration_mm_s2 = number(axis.acceleration);
        rows.add(row, table.line(i).number);
    }
}

std::string axes_words(const Log& log) {
    std::string out;
    for (const AxisColumns& axis : log.axes)
        if (axis.read())
            out += (out.empty() ? "" : ", ") + std::string(1, letter_of(axis.axis)) +
                   (axis.velocity ? " (with commanded speed)" : "");
    return out;
}

std::vector<std::string> rate_columns(const setup::Setup& setup) {
    std::vector<std::string> names{"velocity_mm_s", "acceleration_mm_s2"};
    for (const kinematics::AxisGeometry& axis : setup.machine.chain.axes())
        if (axis.rotary) return {"velocity_mm_s", "velocity_deg_s", "acceleration_mm_s2"};
    return names;
}

void tell(const TextTable& table, const Log& log, const TimeColumn& time, Imported& result) {
    result.summary.push_back(fmt::format("{}: servo log of {}, {} rows, {}; {}", table.path(),
                                         axes_words(log), table.size(), time.words(),
                                         table.dialect_words()));
    if (log.units_assumed)
        result.notes.push_back(table.path() + ": columns without unit taken as mm, deg, mm/s");
    if (time.invented())
        result.notes.push_back(table.path() +
                               ": no column of times: rows one minute apart (--with step_s=0.1)");
    for (const std::string& name : log.unused)
        result.notes.push_back(table.path() + ": column '" + name + "' is not used");
}

}  // namespace

Imported import_axis_log(const ImportRequest& request) {
    Imported result;
    RowWriter rows(request.setup, "axis-log", rate_columns(request.setup), false, true);
    for (const ImportFile& file : request.files) {
        const TextTable table(file.text, file.path);
        const Facts facts = request.facts.with_head_of(table);
        const TimeColumn time(table, facts);
        const Log log = read_columns(table, request.setup, facts, time);
        check(table, log);
        records::Reading row;
        const auto number = &file - request.files.data() + 1;
        row.test = facts.text(
            "test", request.files.size() > 1 ? fmt::format("log_{}", number) : std::string("log"));
        row.commanded = positions_told(request.setup, facts.text("at"));
        rows.begin_file(table, facts);
        std::vector<records::TableCell> cells;
        for (std::size_t i = 0; i < table.size(); ++i) {
            table.read(i, cells);
            row.time_s = time.time_s(table, i, cells);
            write_row(table, i, cells, log, row, rows);
        }
        tell(table, log, time, result);
    }
    result.readings = rows.take();
    return result;
}

}  // namespace trunnion::imports

// A servo log: commanded and actual positions of one or more axes.
#include <fmt/format.h>

#include <algorithm>

#include "base/alarm.h"
#include "imports/log_columns.h"
#include "imports/row_writer.h"
#include "imports/units.h"

namespace trunnion::imports {
namespace {

/// Of positions alone, an axis without any is not in the log.
void drop_empty_axes(const TextTable& table, LogColumns& log) {
    if (!log.places_only()) return;
    std::erase_if(log.axes, [&](const AxisColumns& axis) {
        const bool empty = axis.place() && !table.has_numbers(axis.place()->index);
        if (empty) log.unused.push_back(table.columns()[axis.place()->index].name);
        return empty;
    });
}

/// False for a row without the position of an axis: that of the row before would be invented.
bool has_places(const LineCells& line, LogColumns& log) {
    bool all = true;
    for (AxisColumns& axis : log.axes) {
        if (!axis.place() || !is_missing(line.cells[axis.place()->index].text)) continue;
        ++axis.missing;
        all = false;
    }
    return all;
}

/// Writes a row for each axis with both positions in this line.
void write_row(const LineCells& line, LogColumns& log, records::Reading row, RowWriter& rows) {
    const auto& [table, i, cells] = line;
    const std::string block =
        log.block ? std::string(cells[log.block->column].text) : std::string();
    const bool places_only = log.places_only();
    if (places_only && !has_places(line, log)) return;
    for (AxisColumns& axis : log.axes)
        if (const auto q =
                number_or_none(table, i, cells, places_only ? axis.place() : axis.commanded))
            row.commanded[axis.axis] = places_only ? *q : without_roll_over(axis, *q);
    if (places_only) {
        rows.add(row, table.line(i).number, block);
        return;
    }
    row.device = records::Device::axis;
    for (AxisColumns& axis : log.axes) {
        if (!axis.read()) continue;
        const auto entry = log_entry(table, i, cells, axis);
        if (!entry) {
            ++axis.missing;
            continue;
        }
        row.feature = axis.name;
        row.angular = axis.rotary;
        row.value_mm = entry->error;
        row.velocity_mm_s = number_or_none(table, i, cells, axis.velocity);
        row.acceleration_mm_s2 = number_or_none(table, i, cells, axis.acceleration);
        rows.add(row, table.line(i).number, block);
    }
}

std::vector<std::string> rate_columns(const setup::Setup& setup) {
    std::vector<std::string> names{"velocity_mm_s", "acceleration_mm_s2"};
    for (const kinematics::AxisGeometry& axis : setup.machine.chain.axes())
        if (axis.rotary) return {"velocity_mm_s", "velocity_deg_s", "acceleration_mm_s2"};
    return names;
}

void tell(const TextTable& table, const LogColumns& log, const TimeColumn& time, Imported& result) {
    result.summary.push_back(fmt::format("{}: {} of {}, {} rows, {}; {}", table.path(),
                                         log.places_only() ? "positions" : "servo log",
                                         axes_words(log), table.size(), time.words(),
                                         table.dialect_words()));
    time.note_unit(table, result.notes);
    if (time.invented())
        result.notes.push_back(
            table.path() +
            ": no column of times: rows are taken as one minute apart (--with step_s=0.1)");
    for (std::string& note : log_notes(table, log)) result.notes.push_back(std::move(note));
}

/// A log of positions during a program is compared as a path: an axis that is not in it has no
/// position, which is not 0.
void keep_logged_axes(const ImportRequest& request, const std::vector<TextTable>& tables,
                      RowWriter& rows) {
    std::vector<Axis> axes;
    std::vector<std::string> notes;  // the caller tells them
    for (const TextTable& table : tables) {
        const Facts facts = request.facts.with_head_of(table, notes);
        const TimeColumn time(table, facts);
        LogColumns log = log_columns(table, request.setup, facts, time, true);
        drop_empty_axes(table, log);
        if (!log.places_only() || facts.has("at")) return;
        for (AxisColumns& axis : log.axes)
            if (axis.place()) axes.push_back(axis.axis);
    }
    rows.keep_axes(axes);
}

/// Also where every column names its own unit.
void check_unit(const Facts& facts) {
    const std::string name = facts.text("unit");
    if (!name.empty() && !find_unit(name)) throw InputError("--with: '" + name + "' is no unit");
}

}  // namespace

Imported import_axis_log(const ImportRequest& request) {
    Imported result;
    RowWriter rows(request.setup, "axis-log", rate_columns(request.setup), false, true);
    const std::vector<TextTable> tables = tables_of(request, result.notes);
    check_unit(request.facts);
    keep_logged_axes(request, tables, rows);
    for (const TextTable& table : tables) {
        const Facts facts = request.facts.with_head_of(table, result.notes);
        const TimeColumn time(table, facts);
        LogColumns log = log_columns(table, request.setup, facts, time, true);
        drop_empty_axes(table, log);
        records::Reading row;
        const auto number = &table - tables.data() + 1;
        row.test = facts.text(
            "test", tables.size() > 1 ? fmt::format("log_{}", number) : std::string("log"));
        row.commanded = positions_told(request.setup, facts.text("at"));
        rows.begin_file(table, facts);
        if (time.invented()) rows.invent_times();
        if (time.dated()) rows.name_days();
        if (log.block && number == 1) rows.add_column(log.block->is_line ? "line" : "block");
        std::vector<records::TableCell> cells;
        for (std::size_t i = 0; i < table.size(); ++i) {
            table.read(i, cells);
            row.time_s = time.time_s(table, i, cells);
            if (log.session) row.session = cells[*log.session].plain();
            write_row({table, i, cells}, log, row, rows);
        }
        tell(table, log, time, result);
    }
    result.readings = rows.take();
    return result;
}

}  // namespace trunnion::imports

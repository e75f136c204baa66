// Angles of one or two rotary axes, measured externally: a resolver against a reference, a
// telescope against stars.
#include <fmt/format.h>

#include <algorithm>
#include <deque>

#include "imports/file_tables.h"
#include "imports/log_columns.h"
#include "imports/row_writer.h"
#include "imports/tpoint.h"

namespace trunnion::imports {
namespace {

/// A measured component of the rotation.
struct Component {
    std::string test;
    Vector3 direction_M;
    double angle_rad = 0.0;
};

/// The measured axes of the machine, the carrying one first.
class Mount {
  public:
    Mount(const TextTable& table, const setup::Setup& setup, LogColumns& log) : setup_(setup) {
        const kinematics::Chain& chain = setup.machine.chain;
        for (const auto* side : {&chain.work, &chain.tool})
            for (const kinematics::AxisGeometry& axis : *side)
                if (AxisColumns* columns = columns_of(log, axis.axis)) {
                    if (!axis.rotary)
                        table.header_line().fail(axis.name + " does not turn: import axis-log", 1);
                    axes_.push_back(columns);
                    on_work_.push_back(side == &chain.work);
                }
        if (axes_.size() > 2 || (axes_.size() == 2 && (on_work_[0] || on_work_[1])))
            table.header_line().fail(
                "one rotary axis, or two that carry the line of sight, are read at a time", 1);
    }

    const std::vector<AxisColumns*>& axes() const { return axes_; }

    /// A position of one axis that is read in order goes on at the step from 360 to 0 deg; stars
    /// are anywhere.
    double going_on(AxisColumns& axis, double commanded) const {
        return axes_.size() == 1 ? without_roll_over(axis, commanded) : commanded;
    }

    /// One axis: the rotation about it. Two axes: the line of sight is perpendicular to both when
    /// all axes are at zero; measured are the rotation about the second axis, and the rotation
    /// perpendicular to it and to the line of sight, as an angle on the sky.
    std::vector<Component> components(const AxisPositions& at,
                                      const std::vector<double>& errors_rad) const {
        const Vector3 last = direction_M(axes_.back()->axis, at);
        const std::string name = axes_.back()->name;
        if (axes_.size() == 1) return {{name, on_work_[0] ? Vector3(-last) : last, errors_rad[0]}};
        const Vector3 first = direction_M(axes_[0]->axis, at);
        AxisPositions zero = at;
        zero[axes_[1]->axis] = 0.0;
        const Vector3 sight_at_zero =
            direction_M(axes_[0]->axis, zero).cross(direction_M(axes_[1]->axis, zero)).normalized();
        const Vector3 sight = rotation_about(last, at[axes_[1]->axis]) * sight_at_zero;
        const Vector3 across = sight.cross(last).normalized();
        const Vector3 turned = errors_rad[0] * first + errors_rad[1] * last;
        return {{name, last, last.dot(turned)}, {"across_" + name, across, across.dot(turned)}};
    }

  private:
    static AxisColumns* columns_of(LogColumns& log, Axis axis) {
        for (AxisColumns& columns : log.axes)
            if (columns.axis == axis && columns.read()) return &columns;
        return nullptr;
    }

    /// Direction of a tool-side axis with its carriers at their positions.
    Vector3 direction_M(Axis axis, const AxisPositions& at) const {
        Matrix3 carried = Matrix3::Identity();
        for (const kinematics::AxisGeometry& a : setup_.machine.chain.tool) {
            if (a.axis == axis) return carried * a.direction;
            if (a.rotary) carried *= rotation_about(a.direction, at[a.axis]);
        }
        return setup_.machine.chain.find(axis)->direction;
    }

    const setup::Setup& setup_;
    std::vector<AxisColumns*> axes_;
    std::vector<bool> on_work_;
};

/// Rows of one line of the table; false if one of its values is missing. An axis that is not read
/// carries the others at its position.
bool write_line(const LineCells& line, const LogColumns& log, const Mount& mount,
                records::Reading row, RowWriter& rows) {
    const auto& [table, i, cells] = line;
    std::vector<double> errors_rad;
    for (const AxisColumns& axis : log.axes)
        if (const auto q = number_or_none(table, i, cells, axis.commanded))
            row.commanded[axis.axis] = *q;
    for (AxisColumns* axis : mount.axes()) {
        const auto entry = log_entry(table, i, cells, *axis);
        if (!entry) return false;
        row.commanded[axis->axis] = mount.going_on(*axis, entry->commanded);
        errors_rad.push_back(entry->error);
    }
    const std::string test = row.test;
    for (const Component& component : mount.components(row.commanded, errors_rad)) {
        row.test = test.empty() ? component.test : test + '_' + component.test;
        row.direction_M = component.direction_M;
        row.value_mm = component.angle_rad;
        rows.add(row, table.line(i).number);
    }
    return true;
}

/// Standard uncertainties, in the unit of the column or that of the values.
std::optional<NumberColumn> sigma_of(const TextTable& table, const Facts& facts, LogColumns& log) {
    const auto column = sigma_column(table);
    if (!column) return std::nullopt;
    std::erase(log.unused, table.columns()[*column].name);
    return number_column(table, *column, Quantity::angle, facts.text("unit", "deg"));
}

void import_sights(const TextTable& table, const ImportRequest& request, RowWriter& rows,
                   Imported& result) {
    const setup::Setup& setup = request.setup;
    const Facts facts = request.facts.with_head_of(table, result.notes);
    const TimeColumn time(table, facts);
    LogColumns log = log_columns(table, setup, facts, time);
    const auto sigma = sigma_of(table, facts, log);
    const Mount mount(table, setup, log);
    records::Reading row;
    row.test = facts.text("test");
    row.device = records::Device::angle;
    row.angular = true;
    row.feature = artefact_for(setup, facts.text("feature"), setup::Artefact::Kind::target).name;
    row.commanded = positions_told(setup, facts.text("at"));
    rows.begin_file(table, facts);
    if (time.dated()) rows.name_days();
    if (time.invented()) rows.invent_times();
    const int before = rows.count();
    int missing = 0;
    std::vector<records::TableCell> cells;
    for (std::size_t i = 0; i < table.size(); ++i) {
        table.read(i, cells);
        row.time_s = time.time_s(table, i, cells);
        if (log.session) row.session = cells[*log.session].plain();
        row.sigma_mm = number_or_none(table, i, cells, sigma);
        missing += write_line({table, i, cells}, log, mount, row, rows) ? 0 : 1;
    }
    result.summary.push_back(fmt::format(
        "{}: pointing of {}, {} lines, {} readings, {}; {}", table.path(), axes_words(log),
        table.size(), rows.count() - before, time.words(), table.dialect_words()));
    time.note_unit(table, result.notes);
    if (missing > 0)
        result.notes.push_back(
            fmt::format("{}: {} lines without a value are left out", table.path(), missing));
    for (std::string& note : log_notes(table, log)) result.notes.push_back(std::move(note));
}

/// The tables of a file; a TPOINT run is one, kept in `runs`.
std::vector<TextTable> tables_in(const ImportFile& file, const ImportRequest& request,
                                 std::deque<MadeTable>& runs, std::vector<std::string>& notes) {
    const std::string told = request.facts.text("columns");
    if (!told.empty() || !is_tpoint(file.text)) return tables_of(file.text, file.path, told, notes);
    runs.push_back(tpoint_table(file, request.setup));
    notes.push_back(file.path +
                    ": a TPOINT run: the encoders are the commanded angles, the star is where the "
                    "telescope points; azimuths are as the file counts them (from south or north)");
    return tables_of(runs.back().lines(), file.path, "", notes);
}

}  // namespace

Imported import_pointing(const ImportRequest& request) {
    Imported result;
    std::deque<MadeTable> runs;  // tables refer to them
    std::vector<TextTable> tables;
    for (const ImportFile& file : request.files)
        for (TextTable& table : tables_in(file, request, runs, result.notes))
            tables.push_back(std::move(table));
    const bool sigma = std::any_of(tables.begin(), tables.end(),
                                   [](const TextTable& t) { return sigma_column(t).has_value(); });
    std::vector<std::string> columns;
    if (sigma) columns.emplace_back("sigma_deg");
    RowWriter rows(request.setup, "pointing", columns, true, true);
    for (const TextTable& table : tables) import_sights(table, request, rows, result);
    result.readings = rows.take();
    return result;
}

}  // namespace trunnion::imports

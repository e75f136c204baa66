// Points of a tracker or CMM: nominal and measured coordinates.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/alarm.h"
#include "imports/bed_mesh.h"
#include "imports/file_tables.h"
#include "imports/point_columns.h"
#include "imports/row_writer.h"

namespace trunnion::imports {
namespace {

/// Position of a target in the declared control, in the frame of the instrument.
class CommandedTarget {
  public:
    CommandedTarget(const setup::Setup& setup, const setup::Artefact& target,
                    const setup::Instrument* instrument)
        : setup_(setup),
          nominal_{setup.machine.chain, {}},
          target_(target),
          on_table_(instrument && instrument->sees_table) {
        if (instrument) pose_ = instrument->pose_IM();
    }

    Vector3 point(const AxisPositions& at) const {
        const auto poses = nominal_.poses(at);
        const Vector3 p_M = target_.tool_S_mm ? poses.pose_MS * setup_.target_S_mm(target_)
                                              : poses.pose_MW * target_.center_W_mm;
        return on_table_ ? Vector3(poses.pose_MW.inverse() * p_M) : p_M;
    }
    Vector3 read(const AxisPositions& at) const { return pose_ * point(at); }

    /// X Y Z that bring the target to the nominal point with the other axes unchanged; the position
    /// is linear in them. An axis without a coordinate keeps its position. Empty when the axes do
    /// not move the target.
    std::optional<AxisPositions> reach(AxisPositions at,
                                       const std::array<std::optional<double>, 3>& nominal) const {
        constexpr std::array linear{Axis::X, Axis::Y, Axis::Z};
        const Vector3 begin = point(at);
        Matrix3 way = Matrix3::Identity();
        Vector3 left = Vector3::Zero();
        for (std::size_t d = 0; d < 3; ++d) {
            const auto row = static_cast<Eigen::Index>(d);
            if (nominal[d]) left(row) = *nominal[d] - begin(row);
        }
        for (std::size_t d = 0; d < 3; ++d) {
            if (!nominal[d]) continue;
            AxisPositions moved = at;
            moved[linear[d]] += 1.0;
            const Vector3 step = point(moved) - begin;
            for (std::size_t e = 0; e < 3; ++e) {
                const auto row = static_cast<Eigen::Index>(e);
                way(row, static_cast<Eigen::Index>(d)) = nominal[e] ? step(row) : 0.0;
            }
        }
        if (std::abs(way.determinant()) < 1e-3) return std::nullopt;
        const Vector3 q = way.inverse() * left;
        for (std::size_t d = 0; d < 3; ++d)
            if (nominal[d]) at[linear[d]] += q(static_cast<Eigen::Index>(d));
        return at;
    }

  private:
    const setup::Setup& setup_;
    kinematics::Machine nominal_;  ///< the control's belief, without known errors
    const setup::Artefact& target_;
    bool on_table_;
    Pose pose_;
};

const setup::Instrument* instrument_of(const setup::Setup& setup, const std::string& name) {
    if (name.empty()) return setup.instruments.size() == 1 ? &setup.instruments.front() : nullptr;
    const setup::Instrument* found = setup.find_instrument(name);
    if (!found)
        throw InputError("the setup has no [[instrument]] named '" + name + "'", {setup.path});
    return found;
}

/// The target of the points: the only one, or the one named.
struct PointFile {
    const TextTable& table;
    const PointColumns& columns;
    const CommandedTarget* target;
    const setup::Setup& setup;
    std::vector<MeasuredPoint> points;
};

bool has_slides(const setup::Setup& setup) {
    const AxisNames names = setup.machine.chain.names();
    return std::any_of(all_axes.begin(), all_axes.begin() + 3,
                       [&](Axis axis) { return names.has(axis) && !names.is_rotary(axis); });
}

/// The positions of linear axes are in the file.
bool has_linear(const PointFile& file) {
    return std::any_of(file.columns.axes.begin(), file.columns.axes.end(),
                       [&](const auto& column) { return !turns(file.setup, column.first); });
}

AxisPositions positions_of(const PointFile& file, const MeasuredPoint& point,
                           const std::vector<records::TableCell>& cells, AxisPositions at) {
    for (const auto& [axis, column] : file.columns.axes)
        at[axis] = number_in(file.table, point.row, cells, column);
    const auto told = [](const auto& value) { return value.has_value(); };
    if (has_linear(file) || !has_slides(file.setup) ||
        std::none_of(point.nominal.begin(), point.nominal.end(), told))
        return at;
    const auto reached = file.target->reach(at, point.nominal);
    if (!reached)
        file.table.header_line().fail(
            "X, Y and Z do not move this target in the instrument's frame: give the axis "
            "positions (\"machine x\"), or frame = \"W\" of the instrument",
            1);
    return *reached;
}

/// Writes a row for each measured coordinate.
void write_point(const PointFile& file, const MeasuredPoint& point,
                 const std::vector<records::TableCell>& cells, records::Reading row,
                 RowWriter& rows) {
    if (file.columns.session) row.session = cells[*file.columns.session].plain();
    if (file.columns.sigma)
        row.sigma_mm = number_in(file.table, point.row, cells, *file.columns.sigma);
    row.commanded = positions_of(file, point, cells, row.commanded);
    const Vector3 commanded_mm = file.target->read(row.commanded);
    for (std::size_t d = 0; d < 3; ++d) {
        if (!point.measured[d]) continue;
        const auto component = static_cast<Eigen::Index>(d);
        row.direction_M = Vector3::Unit(component);
        row.value_mm = *point.measured[d] - commanded_mm(component);
        rows.add(row, file.table.line(point.rows[d]).number);
    }
}

/// Points of one instrument in one session.
struct SessionPoints {
    std::size_t count = 0;
    SourceRef first;
    std::string text;  ///< line of the first one
};
using PointCounts = std::map<std::pair<std::string, std::string>, SessionPoints>;

/// A free pose has six parameters for each session: at least three points are required.
void check_poses(const setup::Setup& setup, const PointCounts& counts) {
    constexpr std::size_t fewest = 3;
    for (const auto& [key, points] : counts) {
        const auto& [name, session] = key;
        const setup::Instrument* instrument = setup.find_instrument(name);
        if (!instrument || !instrument->free_pose || points.count >= fewest) continue;
        throw InputError(fmt::format("{} point{} of {}{} not fix its pose, which the setup leaves "
                                     "free: three at least",
                                     points.count, points.count == 1 ? "" : "s", name,
                                     session.empty() ? " do" : " in session " + session + " do"),
                         points.first, points.text);
    }
}

void tell(const PointFile& file, const TimeColumn& time, const std::string& instrument,
          const LeftOut& left_out, Imported& result) {
    const TextTable& table = file.table;
    const PointColumns& columns = file.columns;
    const bool nominal = std::any_of(columns.nominal.begin(), columns.nominal.end(),
                                     [](auto& c) { return c.has_value(); });
    result.summary.push_back(
        fmt::format("{}: {} points ({}), read by {}; {}", table.path(), file.points.size(),
                    nominal ? "nominal and measured" : "axis positions and measured",
                    instrument.empty() ? "an instrument in M" : instrument, table.dialect_words()));
    time.note_unit(table, result.notes);
    if (time.invented())
        result.notes.push_back(table.path() +
                               ": no column of times: points are taken as one minute apart");
    left_out.note(table.path(), result.notes);
    for (const std::string& name : columns.unused)
        result.notes.push_back(table.path() + ": column '" + name + "' is not used");
}

void count_point(const TextTable& table, std::size_t row,
                 const std::pair<std::string, std::string>& key, PointCounts& counts) {
    const records::TableLine line = table.line(row);
    const auto [at, is_first] = counts.try_emplace(key);
    if (is_first) {
        at->second.first = {table.path(), line.number, 1};
        at->second.text = line.text;
    }
    ++at->second.count;
}

struct PointOutput {
    RowWriter& rows;
    PointCounts& counts;
    Imported& result;
};

/// The targets of a column `feature`, or the one of --with feature=, or the only one.
class Targets {
  public:
    Targets(const setup::Setup& setup, std::string told, const setup::Instrument* instrument)
        : setup_(setup), told_(std::move(told)), instrument_(instrument) {}

    const CommandedTarget& named(const std::string& name, records::Reading& row, RowWriter& rows) {
        const setup::Artefact& artefact =
            artefact_for(setup_, name.empty() ? told_ : name, setup::Artefact::Kind::target);
        row.feature = artefact.name;
        const auto [at, is_first] =
            targets_.try_emplace(artefact.name, setup_, artefact, instrument_);
        if (is_first) rows.declare("target " + artefact.name);
        return at->second;
    }

  private:
    const setup::Setup& setup_;
    std::string told_;
    const setup::Instrument* instrument_;
    std::map<std::string, CommandedTarget> targets_;
};

void import_table_of_points(const TextTable& table, const ImportRequest& request,
                            const PointOutput& out) {
    const auto& [rows, counts, result] = out;
    const setup::Setup& setup = request.setup;
    const Facts facts = request.facts.with_head_of(table, result.notes);
    const TimeColumn time(table, facts);
    const PointColumns columns = point_columns(table, setup, facts, time);
    const setup::Instrument* instrument = instrument_of(setup, facts.text("instrument"));
    Targets targets(setup, facts.text("feature"), instrument);
    records::Reading row;
    row.test = facts.text("test", "points");
    row.device = records::Device::point;
    if (instrument) row.instrument = instrument->name;
    row.commanded = positions_told(setup, facts.text("at"));
    rows.begin_file(table, facts);
    if (time.dated()) rows.name_days();
    if (time.invented()) rows.invent_times();
    rows.declare("chain");
    rows.declare(instrument ? "instrument " + instrument->name : "instrument");
    LeftOut left_out;
    PointFile file{table, columns, nullptr, setup, measured_points(table, columns, left_out)};
    std::vector<records::TableCell> cells;
    for (const MeasuredPoint& point : file.points) {
        table.read(point.row, cells);
        row.time_s = time.time_s(table, point.row, cells);
        const std::string feature = columns.feature ? cells[*columns.feature].plain() : "";
        file.target = &targets.named(feature, row, rows);
        const int before = rows.count();
        if (!has_linear(file) && lacks_nominal(columns, point)) {
            left_out.values.add(table.line(point.row).number, "nominal");
            continue;
        }
        write_point(file, point, cells, row, rows);
        if (rows.count() > before)
            count_point(table, point.row, {row.instrument, rows.session()}, counts);
    }
    tell(file, time, row.instrument, left_out, result);
}

void import_file_of_points(const ImportFile& file, const ImportRequest& request,
                           const PointOutput& out) {
    std::vector<std::string>& notes = out.result.notes;
    const std::string told = request.facts.text("columns");
    if (!is_bed_mesh(file.text)) {
        for (const TextTable& table : tables_of(file.text, file.path, told, notes))
            import_table_of_points(table, request, out);
        return;
    }
    const MadeTable mesh = bed_mesh_table(file);
    notes.push_back(file.path +
                    ": a bed mesh: its points are measured heights, their nominal Z is 0");
    for (const TextTable& table : tables_of(mesh.lines(), file.path, "", notes))
        import_table_of_points(table, request, out);
}

}  // namespace

Imported import_points(const ImportRequest& request) {
    Imported result;
    RowWriter rows(request.setup, "points", {"sigma_mm", "instrument"}, true, false);
    PointCounts counts;
    for (const ImportFile& file : request.files)
        import_file_of_points(file, request, {rows, counts, result});
    check_poses(request.setup, counts);
    if (request.files.size() > 1 && rows.session().empty())
        result.notes.push_back(
            fmt::format("{} files are one set-up: the part has one pose in all of them; if it was "
                        "mounted again in between, --with session=each gives each file its own",
                        request.files.size()));
    result.readings = rows.take();
    return result;
}

}  // namespace trunnion::imports

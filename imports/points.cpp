// Points of a tracker or CMM: nominal and measured coordinates.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/alarm.h"
#include "imports/column_roles.h"
#include "imports/row_writer.h"

namespace trunnion::imports {
namespace {

using ThreeColumns = std::array<std::optional<NumberColumn>, 3>;

struct PointColumns {
    ThreeColumns nominal, measured;
    std::vector<std::pair<Axis, NumberColumn>> axes;  ///< positions of the machine's axes
    std::optional<NumberColumn> sigma;
    std::optional<std::size_t> session;
    std::vector<std::string> unused;
};

bool complete(const ThreeColumns& columns) {
    return std::all_of(columns.begin(), columns.end(), [](auto& c) { return c.has_value(); });
}

/// A coordinate without a word ("x") is a measured one.
void take(const TextTable& table, std::size_t k, const ColumnRole& role, const setup::Setup& setup,
          const Facts& facts, PointColumns& columns) {
    const TextColumn& column = table.columns()[k];
    const auto axis = axis_named(setup, std::string(1, role.axis));
    const std::string unit = facts.text("unit", "mm");
    const std::size_t d = std::string_view("XYZ").find(role.axis);
    if (role.machine || d == std::string_view::npos) {
        if (axis) {
            const bool rotary = is_rotary(*axis);
            columns.axes.emplace_back(
                *axis, number_column(table, k, rotary ? Quantity::angle : Quantity::length,
                                     rotary ? "deg" : unit));
        } else {
            columns.unused.push_back(column.name);
        }
        return;
    }
    auto& place = role.role == Role::commanded ? columns.nominal[d] : columns.measured[d];
    if (place) table.header_line().fail("a second column for this coordinate", column.column);
    place = number_column(table, k, Quantity::length, unit);
}

PointColumns read_columns(const TextTable& table, const setup::Setup& setup, const Facts& facts,
                          const TimeColumn& time) {
    PointColumns columns;
    columns.session = find_column(table, {"session", "setup", "tag", "day"});
    const auto sigma = find_column(table, {"sigma", "u", "uncertainty", "unsicherheit"});
    if (sigma)
        columns.sigma = number_column(table, *sigma, Quantity::length, facts.text("unit", "mm"));
    for (std::size_t k = 0; k < table.columns().size(); ++k) {
        if (time.column() == k || columns.session == k || sigma == k) continue;
        const auto role = role_of(table.columns()[k].name);
        if (role && role->rate == Rate::position && role->role != Role::error &&
            role->role != Role::following_error)
            take(table, k, *role, setup, facts, columns);
        else
            columns.unused.push_back(table.columns()[k].name);
    }
    if (!complete(columns.measured))
        table.header_line().fail("no columns of measured x, y and z", 1);
    if (!complete(columns.nominal) && columns.axes.empty())
        table.header_line().fail(
            "no columns of nominal x, y and z, and none of axis positions (\"machine x\")", 1);
    return columns;
}

Vector3 three(const TextTable& table, std::size_t i, const std::vector<records::TableCell>& cells,
              const ThreeColumns& columns) {
    Vector3 p;
    for (std::size_t d = 0; d < 3; ++d)
        p(static_cast<Eigen::Index>(d)) = number_in(table, i, cells, *columns[d]);
    return p;
}

/// Where the declared control puts a target, in the frame that the instrument reads.
class CommandedTarget {
  public:
    CommandedTarget(const setup::Setup& setup, const setup::Artefact& target,
                    const setup::Instrument* instrument)
        : machine_(setup.machine),
          target_(target),
          on_table_(instrument && instrument->sees_table) {
        if (instrument) pose_ = instrument->pose_IM();
    }

    Vector3 point(const AxisPositions& at) const {
        const auto poses = machine_.poses(at);
        const Vector3 p_M = target_.tool_S_mm ? poses.pose_MS * *target_.tool_S_mm
                                              : poses.pose_MW * target_.center_W_mm;
        return on_table_ ? Vector3(poses.pose_MW.inverse() * p_M) : p_M;
    }
    Vector3 read(const AxisPositions& at) const { return pose_ * point(at); }

    /// X, Y and Z that bring the target to the nominal point, the other axes as they stand: the way
    /// is linear in them. Nothing when they do not move it.
    std::optional<AxisPositions> reach(AxisPositions at, const Vector3& nominal) const {
        constexpr std::array linear{Axis::X, Axis::Y, Axis::Z};
        for (const Axis axis : linear) at[axis] = 0.0;
        const Vector3 zero = point(at);
        Matrix3 way;
        for (std::size_t d = 0; d < 3; ++d) {
            AxisPositions moved = at;
            moved[linear[d]] = 1.0;
            way.col(static_cast<Eigen::Index>(d)) = point(moved) - zero;
        }
        if (std::abs(way.determinant()) < 1e-3) return std::nullopt;
        const Vector3 q = way.inverse() * (nominal - zero);
        for (std::size_t d = 0; d < 3; ++d) at[linear[d]] = q(static_cast<Eigen::Index>(d));
        return at;
    }

  private:
    const kinematics::Machine& machine_;
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

/// The target that the points are of: the only one, or the one named.
struct PointFile {
    const TextTable& table;
    const PointColumns& columns;
    const CommandedTarget& target;
};

AxisPositions positions_of(const PointFile& file, std::size_t i,
                           const std::vector<records::TableCell>& cells, AxisPositions at) {
    bool linear = false;
    for (const auto& [axis, column] : file.columns.axes) {
        at[axis] = number_in(file.table, i, cells, column);
        linear |= !is_rotary(axis);
    }
    if (linear || !complete(file.columns.nominal)) return at;
    const auto reached = file.target.reach(at, three(file.table, i, cells, file.columns.nominal));
    if (!reached)
        file.table.header_line().fail(
            "X, Y and Z do not move this target in the instrument's frame: give the axis "
            "positions (\"machine x\"), or frame = \"W\" of the instrument",
            1);
    return *reached;
}

void write_point(const PointFile& file, std::size_t i, const std::vector<records::TableCell>& cells,
                 records::Reading row, RowWriter& rows) {
    if (file.columns.session) row.session = cells[*file.columns.session].plain();
    if (file.columns.sigma) row.sigma_mm = number_in(file.table, i, cells, *file.columns.sigma);
    row.commanded = positions_of(file, i, cells, row.commanded);
    const Vector3 apart =
        three(file.table, i, cells, file.columns.measured) - file.target.read(row.commanded);
    for (Eigen::Index d = 0; d < 3; ++d) {
        row.direction_M = Vector3::Unit(d);
        row.value_mm = apart(d);
        rows.add(row, file.table.line(i).number);
    }
}

/// A pose that is free for each session takes six numbers of it: three points at least.
void check_pose(const PointFile& file, const setup::Instrument* instrument) {
    if (!instrument || !instrument->free_pose) return;
    constexpr std::size_t fewest = 3;
    std::map<std::string, std::pair<std::size_t, std::size_t>> sessions;  // first row, points
    std::vector<records::TableCell> cells;
    for (std::size_t i = 0; i < file.table.size(); ++i) {
        file.table.read(i, cells);
        const std::string name = file.columns.session ? cells[*file.columns.session].plain() : "";
        ++sessions.try_emplace(name, i, 0).first->second.second;
    }
    for (const auto& [name, entry] : sessions)
        if (entry.second < fewest)
            file.table.line(entry.first)
                .fail(fmt::format("{} point{} of {}{} not fix its pose, which the setup leaves "
                                  "free: three at least",
                                  entry.second, entry.second == 1 ? "" : "s", instrument->name,
                                  name.empty() ? " do" : " in session " + name + " do"),
                      1);
}

void tell(const PointFile& file, const TimeColumn& time, const std::string& instrument,
          Imported& result) {
    const TextTable& table = file.table;
    result.summary.push_back(fmt::format(
        "{}: {} points ({}), read by {}; {}", table.path(), table.size(),
        complete(file.columns.nominal) ? "nominal and measured" : "axis positions and measured",
        instrument.empty() ? "an instrument in M" : instrument, table.dialect_words()));
    if (time.invented())
        result.notes.push_back(table.path() + ": no column of times: points one minute apart");
    for (const std::string& name : file.columns.unused)
        result.notes.push_back(table.path() + ": column '" + name + "' is not used");
}

}  // namespace

Imported import_points(const ImportRequest& request) {
    const setup::Setup& setup = request.setup;
    Imported result;
    RowWriter rows(setup, "points", {"sigma_mm", "instrument"}, true, false);
    for (const ImportFile& file : request.files) {
        const TextTable table(file.text, file.path);
        const Facts facts = request.facts.with_head_of(table);
        const TimeColumn time(table, facts);
        const PointColumns columns = read_columns(table, setup, facts, time);
        const setup::Artefact& artefact =
            artefact_for(setup, facts.text("feature"), setup::Artefact::Kind::target);
        const setup::Instrument* instrument = instrument_of(setup, facts.text("instrument"));
        const CommandedTarget target(setup, artefact, instrument);
        records::Reading row;
        row.test = facts.text("test", "points");
        row.device = records::Device::point;
        row.feature = artefact.name;
        if (instrument) row.instrument = instrument->name;
        row.commanded = positions_told(setup, facts.text("at"));
        rows.begin_file(table, facts);
        const PointFile points{table, columns, target};
        check_pose(points, instrument);
        std::vector<records::TableCell> cells;
        for (std::size_t i = 0; i < table.size(); ++i) {
            table.read(i, cells);
            row.time_s = time.time_s(table, i, cells);
            write_point(points, i, cells, row, rows);
        }
        tell(points, time, row.instrument, result);
    }
    result.readings = rows.take();
    return result;
}

}  // namespace trunnion::imports

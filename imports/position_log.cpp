#include "imports/position_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "base/units.h"
#include "imports/column_roles.h"
#include "imports/file_tables.h"
#include "imports/grid_step.h"
#include "imports/log_columns.h"
#include "imports/times.h"
#include "imports/unknown_columns.h"

namespace trunnion::imports {
namespace {

using Cells = std::vector<records::TableCell>;

constexpr double farthest = 1e7;  ///< mm or rad

struct PositionColumn {
    Axis axis = Axis::X;
    Role role = Role::none;
    NumberColumn numbers;
};

struct PositionColumns {
    std::vector<PositionColumn> positions;
    std::optional<BlockColumnFound> block;
    std::optional<std::size_t> program, motion, sigma;
    std::array<std::optional<std::size_t>, 7> arc;  ///< centre, normal, turns

    std::set<std::size_t> used() const {
        std::set<std::size_t> out;
        for (const auto& column : {program, motion, sigma})
            if (column) out.insert(*column);
        for (const auto& column : arc)
            if (column) out.insert(*column);
        if (block) out.insert(block->column);
        return out;
    }
};

std::string axes_of(const setup::Setup& setup) {
    std::string out;
    for (const kinematics::AxisGeometry& axis : setup.machine.chain.axes())
        if (is_letter(axis)) out += (out.empty() ? "" : " ") + std::string(1, letter_of(axis.axis));
    return out;
}

/// Commanded positions have priority over actual ones; errors and speeds are no positions.
bool is_better(Role a, Role b) {
    return a == Role::commanded && b != Role::commanded;
}

void take_position(PositionColumns& out, const PositionColumn& found, const TextTable& table,
                   const TextColumn& column) {
    for (PositionColumn& known : out.positions) {
        if (known.axis != found.axis) continue;
        if (known.role == found.role)
            table.header_line().fail("a second column of positions of this axis", column.column);
        if (is_better(found.role, known.role)) known = found;
        return;
    }
    out.positions.push_back(found);
}

void read_positions(const TextTable& table, const setup::Setup& setup, PositionColumns& out) {
    for (std::size_t k = 0; k < table.columns().size(); ++k) {
        const TextColumn& column = table.columns()[k];
        const auto role = role_of(column.name, setup.machine.chain.names());
        if (!role || role->rate != Rate::position || role->role == Role::error ||
            role->role == Role::following_error)
            continue;
        const auto axis = axis_named(setup, role->axis);
        if (!axis)
            table.header_line().fail(
                fmt::format("'{}': the machine's axes are {}", column.name, axes_of(setup)),
                column.column);
        take_position(
            out,
            {*axis, role->role,
             number_column(table, k, is_rotary(*axis) ? Quantity::angle : Quantity::length,
                           is_rotary(*axis) ? "deg" : "mm")},
            table, column);
    }
    if (out.positions.empty())
        table.header_line().fail("no column tells the position of an axis (x_mm, \"X cmd [mm]\")",
                                 1);
}

PositionColumns columns_of(const TextTable& table, const setup::Setup& setup) {
    PositionColumns out;
    read_positions(table, setup, out);
    out.block = find_block_column(table);
    out.program = find_column(table, {"program", "programm", "ncprogram"});
    out.motion = find_column(table, {"motion"});
    out.sigma = find_column(table, {"sigma"});
    const char* const names[] = {"centerx", "centery", "centerz", "normalx",
                                 "normaly", "normalz", "turns"};
    for (std::size_t k = 0; k < out.arc.size(); ++k) out.arc[k] = find_column(table, {names[k]});
    return out;
}

int block_in(const TextTable& table, std::size_t row, const records::TableCell& cell) {
    if (cell.text.empty()) return 0;
    const bool letter = cell.text.front() == 'N' || cell.text.front() == 'n';
    const auto number = table.find_number(letter ? cell.text.substr(1) : cell.text);
    if (!number || *number < 0 || *number > 2e9 || *number != std::floor(*number))
        table.line(row).fail("a block is a whole number", cell.column);
    return static_cast<int>(*number);
}

std::optional<records::LoggedArc> arc_in(const TextTable& table, std::size_t row,
                                         const Cells& cells, const PositionColumns& columns) {
    std::array<double, 7> value{};
    for (std::size_t k = 0; k < value.size(); ++k) {
        if (!columns.arc[k] || cells[*columns.arc[k]].text.empty()) return std::nullopt;
        value[k] = table.number(row, cells[*columns.arc[k]], "arc");
    }
    if (value[6] == 0.0) return std::nullopt;
    return records::LoggedArc{
        {value[0], value[1], value[2]}, {value[3], value[4], value[5]}, value[6]};
}

/// Digits after the point; 15 for a number with an exponent.
int decimals_of(std::string_view text) {
    if (text.find_first_of("eE") != std::string_view::npos) return 15;
    const std::size_t point = text.find_last_of(".,");
    return point == std::string_view::npos ? 0 : static_cast<int>(text.size() - point - 1);
}

records::LoggedPosition row_of(const TextTable& table, std::size_t i, const Cells& cells,
                               const PositionColumns& columns) {
    records::LoggedPosition row;
    row.line = table.line(i).number;
    for (const PositionColumn& column : columns.positions) {
        const double at = number_in(table, i, cells, column.numbers);
        if (!(std::abs(at) <= farthest))
            table.line(i).fail("no axis goes as far: is it the right column and unit?",
                               cells[column.numbers.index].column);
        row.at[column.axis] = at;
    }
    if (columns.block) row.block = block_in(table, i, cells[columns.block->column]);
    if (columns.program) row.program = cells[*columns.program].plain();
    if (columns.sigma && !cells[*columns.sigma].text.empty())
        row.sigma_mm = table.number(i, cells[*columns.sigma], "sigma");
    row.arc = arc_in(table, i, cells, columns);
    return row;
}

/// The least increment visible in the numbers of a log.
class PrintedStep {
  public:
    explicit PrintedStep(const PositionColumns& columns) : columns_(columns) {}

    void add(const Cells& cells) {
        for (const PositionColumn& column : columns_.positions) {
            const int decimals = decimals_of(cells[column.numbers.index].text);
            fewest_ = std::min(fewest_, decimals);
            const double unit = is_rotary(column.axis) ? deg_from_rad(column.numbers.factor)
                                                       : column.numbers.factor;
            step_ = std::min(step_, unit * std::pow(10.0, -decimals));
            most_ = std::max(most_, decimals);
        }
    }
    /// If trailing zeros are omitted, few decimals give no information.
    double least() const { return step_; }
    double step() const {
        return fewest_ == most_ && most_ > 0 ? step_ : std::min(step_, usual_step);
    }

  private:
    static constexpr double usual_step = 1e-3;  ///< mm or deg, usual for controls
    const PositionColumns& columns_;
    double step_ = 1.0;
    int fewest_ = 99, most_ = 0;
};

bool repeats(const records::LoggedPosition& row, const records::LoggedPosition& before) {
    return row.at == before.at && row.block == before.block && row.program == before.program;
}

/// Refuses times that run backwards: positions are compared in the order of the rows.
class RowOrder {
  public:
    /// Not "t", which may be the tool.
    explicit RowOrder(const TextTable& table)
        : table_(table),
          column_(find_first_column(
              table,
              {{"time", "zeit"}, {"timestamp", "zeitstempel"}, {"elapsed", "elapsedtime"}})) {}

    const std::optional<std::size_t>& column() const { return column_; }
    /// Time since the row before, in the column's unit; negative: not known.
    double check(std::size_t row, const Cells& cells) {
        if (!column_) return -1.0;
        const records::TableCell& cell = cells[*column_];
        const auto number = table_.find_number(cell.text);
        const auto time = number ? number : seconds_of(cell.text);
        if (!time) return -1.0;
        // A time of day begins again at midnight.
        const bool midnight = !number && last_ - *time > half_a_day_s;
        if (*time < last_ && !midnight)
            table_.line(row).fail("the times run backwards: the rows must stand in their order",
                                  cell.column);
        const double since = *time - last_;
        last_ = *time;
        return std::isfinite(since) ? since : -1.0;
    }

  private:
    static constexpr double half_a_day_s = 43200.0;
    const TextTable& table_;
    std::optional<std::size_t> column_;
    double last_ = -std::numeric_limits<double>::infinity();
};

/// Where a log of even times has lost rows: few times longer than the others.
class LostRows {
  public:
    /// `row`: the last one kept before the time.
    void add(double since, std::size_t row) {
        if (since > 0.0) times_.push_back({since, row});
    }
    void mark(std::vector<records::LoggedPosition>& rows) const {
        if (times_.size() < least_times) return;
        std::vector<double> all;
        for (const Time& time : times_) all.push_back(time.since);
        const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
        std::nth_element(all.begin(), middle, all.end());
        const double usual = *middle;
        std::size_t even = 0;
        std::vector<std::size_t> lost;
        for (const Time& time : times_) {
            even += time.since <= alike * usual ? 1 : 0;
            if (time.since > far_longer * usual) lost.push_back(time.row);
        }
        const bool few = lost.size() * times_a_gap <= times_.size();
        if (!few || static_cast<double>(even) < most_even * static_cast<double>(times_.size()))
            return;
        for (const std::size_t row : lost) rows[row].cut = true;
    }

  private:
    struct Time {
        double since;
        std::size_t row;
    };
    static constexpr std::size_t least_times = 50, times_a_gap = 50;
    static constexpr double alike = 1.5, far_longer = 3.5, most_even = 0.9;
    std::vector<Time> times_;
};

}  // namespace

records::PositionLog read_position_log(std::string_view text, const std::string& path,
                                       const setup::Setup& setup) {
    std::vector<std::string> notes;
    const std::vector<TextTable> tables = tables_of(text, path, "", notes);
    const TextTable& table = tables.front();
    const PositionColumns columns = columns_of(table, setup);
    records::PositionLog log;
    log.path = path;
    for (const PositionColumn& column : columns.positions) log.axes.push_back(column.axis);
    if (columns.block)
        log.blocks =
            columns.block->is_line ? records::BlockColumn::line : records::BlockColumn::number;
    log.ends = columns.motion.has_value();
    PrintedStep printed(columns);
    RowOrder order(table);
    std::set<std::size_t> used = columns.used();
    if (order.column()) used.insert(*order.column());
    log.unknown = unknown_columns(table, setup.machine.chain.names(), used);
    LostRows lost;
    Cells cells;
    for (std::size_t i = 0; i < table.size(); ++i) {
        table.read(i, cells);
        const double since = order.check(i, cells);
        if (!log.rows.empty()) lost.add(since, log.rows.size() - 1);
        const bool sample = columns.motion && cells[*columns.motion].text == "SAMPLE";
        log.ends = log.ends && !sample;
        printed.add(cells);
        records::LoggedPosition row = row_of(table, i, cells, columns);
        row.end = columns.motion && !sample;
        if (log.rows.empty() || !repeats(row, log.rows.back())) {
            log.rows.push_back(std::move(row));
        } else {
            log.rows.back().end = log.rows.back().end || row.end;
            ++log.rows.back().repeated;
        }
    }
    if (log.rows.empty()) table.header_line().fail("no row below this line", 1);
    if (!log.ends) lost.mark(log.rows);
    log.step = std::max(printed.step(), grid_step(log, printed.least()));
    return log;
}

}  // namespace trunnion::imports

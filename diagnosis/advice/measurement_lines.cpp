#include "diagnosis/advice/measurement_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace trunnion::diagnosis {
namespace {

constexpr double beside_mm = 200.0;  ///< of a parallel line
constexpr double enough_aside_mm = 100.0;
constexpr double least_room_mm = 50.0;  ///< of a line that is worth measuring
constexpr double read_s = 5.0;          ///< by hand, where no clock was read
constexpr double prepare_min = 10.0;

double duration_s(const records::ReadingTable& table) {
    const double by_hand = read_s * static_cast<double>(table.rows.size());
    if (!records::has_times(table)) return by_hand;
    const double clock = table.rows.back().time_s - table.rows.front().time_s;
    return clock > 0.0 ? clock : by_hand;
}

/// Times from `start_s` on, in the same order.
void start_at(records::ReadingTable& table, double start_s) {
    const double first = table.rows.front().time_s;
    for (records::Reading& row : table.rows) row.time_s += start_s - first;
}

}  // namespace

bool reads(const records::ReadingTable& table, records::Device device) {
    return std::any_of(table.rows.begin(), table.rows.end(),
                       [&](const records::Reading& r) { return r.device == device; });
}

bool logs_axes(const records::ReadingTable& table) {
    return reads(table, records::Device::axis);
}

std::string readings_of(const records::ReadingTable& table) {
    if (logs_axes(table)) return "the recorded moves";
    if (reads(table, records::Device::point)) return "the points";
    return "the lines";
}

Measurement repeat_of(const Again& again, std::string name, std::string text,
                      records::ReadingTable table) {
    if (reads(table, records::Device::point))
        text +=
            "; if the part or the instrument is mounted or aligned again, import them with "
            "--with session=NAME";
    table.path = "measurement " + name;
    Measurement m{std::move(name), std::move(text), "", std::move(table)};
    m.minutes = prepare_min + duration_s(m.table) / 60.0;
    start_at(m.table, again.start_s);
    return m;
}

std::map<std::string, std::vector<Axis>> moving_axes(const records::ReadingTable& table) {
    std::map<std::string, const records::Reading*> first;
    std::map<std::string, std::vector<Axis>> moving;
    for (const records::Reading& row : table.rows) {
        const records::Reading& start = *first.try_emplace(row.test, &row).first->second;
        std::vector<Axis>& list = moving[row.test];
        for (const Axis axis : table.axes)
            if (row.commanded[axis] != start.commanded[axis] &&
                std::find(list.begin(), list.end(), axis) == list.end())
                list.push_back(axis);
    }
    return moving;
}

namespace {

/// A step of an axis at rest to a parallel line, within its travel; 0 without room.
double step_aside_mm(const kinematics::AxisGeometry& axis, double at_mm) {
    const double up = axis.max ? std::min(beside_mm, *axis.max - at_mm) : beside_mm;
    const double down = axis.min ? std::min(beside_mm, at_mm - *axis.min) : beside_mm;
    const double step = up >= down ? up : -down;
    return std::abs(step) < least_room_mm ? 0.0 : std::trunc(step);
}

/// "200 mm", or "0 to 300 mm": the positions of an axis in the rows of a device.
std::string places_of(const records::ReadingTable& table, Axis axis) {
    double low = 1e300, high = -1e300;
    for (const records::Reading& row : table.rows) {
        if (row.device == records::Device::none) continue;
        low = std::min(low, row.commanded[axis]);
        high = std::max(high, row.commanded[axis]);
    }
    return low == high ? fmt::format("{:.4g} mm", low)
                       : fmt::format("{:.4g} to {:.4g} mm", low, high);
}

/// Lines beside those of the present readings, and the smallest step to them.
struct Beside {
    records::ReadingTable table;
    double least_mm = beside_mm;
};

/// The tests in which an axis rests, on lines a step of that axis aside.
Beside parallel_lines(const Again& again, const kinematics::AxisGeometry& axis) {
    const auto moving = moving_axes(again.table);
    const std::string& name = again.table.names[axis.axis];
    Beside beside{again.table};
    beside.table.rows.clear();
    for (records::Reading row : again.table.rows) {
        const std::vector<Axis>& own = moving.at(row.test);
        const double step = step_aside_mm(axis, row.commanded[axis.axis]);
        if (step == 0.0 || std::find(own.begin(), own.end(), axis.axis) != own.end()) continue;
        beside.least_mm = std::min(beside.least_mm, std::abs(step));
        row.commanded[axis.axis] += step;
        row.point_W_mm.reset();
        row.test += " " + name + " aside";
        beside.table.rows.push_back(std::move(row));
    }
    return beside;
}

/// Half the step that was planned tells less, but mostly enough.
std::string aside_words(double step_mm) {
    return fmt::format("at least {:.0f} mm aside",
                       std::max(0.5 * step_mm, std::min(step_mm, enough_aside_mm)));
}

/// The rows of one test with the places of its axis moved to another axis, within its travel.
records::ReadingTable line_along(const Again& again, const kinematics::AxisGeometry& axis,
                                 const std::pair<const std::string, std::vector<Axis>>& pattern) {
    const Axis from = pattern.second.front();
    records::ReadingTable table = again.table;
    std::erase_if(table.rows, [&](const records::Reading& row) {
        return row.test != pattern.first ||
               (row.device != records::Device::none && row.device != records::Device::linear);
    });
    double low = 1e300, high = -1e300;
    for (const records::Reading& row : table.rows) {
        low = std::min(low, row.commanded[from]);
        high = std::max(high, row.commanded[from]);
    }
    if (!reads(table, records::Device::linear) || !(low < high)) table.rows.clear();
    if (table.rows.empty()) return table;
    const double rest = table.rows.front().commanded[axis.axis];
    const double room = axis.min && axis.max ? *axis.max - *axis.min : high - low;
    const double part = std::min(1.0, room / (high - low)), way = part * (high - low);
    double start = rest;
    if (axis.max) start = std::min(start, *axis.max - way);
    if (axis.min) start = std::max(start, *axis.min);
    for (records::Reading& row : table.rows) {
        row.commanded[axis.axis] = start + part * (row.commanded[from] - low);
        row.commanded[from] = low;
        row.test = "along " + axis.name;
        row.point_W_mm.reset();
        if (row.device != records::Device::none) row.direction_M = axis.direction;
    }
    return table;
}

}  // namespace

void add_parallel_lines(const Again& again, std::vector<Measurement>& list) {
    records::ReadingTable all = again.table;
    all.rows.clear();
    std::string names;
    std::size_t count = 0;
    double least_mm = beside_mm;
    for (const kinematics::AxisGeometry& axis : again.setup.machine.chain.axes()) {
        if (axis.rotary) continue;
        Beside beside = parallel_lines(again, axis);
        records::ReadingTable& table = beside.table;
        if (table.rows.empty()) continue;
        least_mm = std::min(least_mm, beside.least_mm);
        const std::string& name = again.table.names[axis.axis];
        double later_s = 0.0;
        if (!all.rows.empty()) later_s = all.rows.back().time_s - table.rows.front().time_s;
        for (records::Reading row : table.rows) {
            row.time_s += later_s;
            all.rows.push_back(std::move(row));
        }
        const std::string place = fmt::format("with {} at {}", name, places_of(table, axis.axis));
        names += (count++ ? ", then " : "") + place;
        list.push_back(repeat_of(again, "parallel_" + name,
                                 fmt::format("take {} again {}, {}", readings_of(again.table),
                                             place, aside_words(beside.least_mm)),
                                 std::move(table)));
    }
    if (count < 2) return;
    list.push_back(repeat_of(
        again, "parallel_all",
        fmt::format("take {} again {}, {}", readings_of(again.table), names, aside_words(least_mm)),
        std::move(all)));
}

void add_other_axes(const Again& again, std::vector<Measurement>& list) {
    if (again.table.rows.empty() || !reads(again.table, records::Device::linear)) return;
    const auto moving = moving_axes(again.table);
    std::set<Axis> measured;
    for (const auto& [test, axes] : moving) measured.insert(axes.begin(), axes.end());
    // The first line along one axis is the pattern.
    const auto pattern = std::find_if(moving.begin(), moving.end(), [&](const auto& test) {
        return test.second.size() == 1 && !again.table.names.is_rotary(test.second.front());
    });
    if (pattern == moving.end()) return;
    for (const kinematics::AxisGeometry& axis : again.setup.machine.chain.axes()) {
        if (axis.rotary || measured.contains(axis.axis)) continue;
        records::ReadingTable table = line_along(again, axis, *pattern);
        if (table.rows.empty()) continue;
        const std::string place = fmt::format("{} {}", axis.name, places_of(table, axis.axis));
        list.push_back(repeat_of(again, "line_" + axis.name,
                                 fmt::format("take a line along {}, too", place),
                                 std::move(table)));
    }
}

}  // namespace trunnion::diagnosis

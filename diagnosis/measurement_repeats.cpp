#include "diagnosis/measurement_repeats.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/units.h"
#include "diagnosis/thinning.h"

namespace trunnion::diagnosis {
namespace {

constexpr std::size_t enough_rows = 1000;
constexpr double lower_mm = 100.0;      ///< of a target further from the spindle nose
constexpr double beside_mm = 200.0;     ///< of a parallel line
constexpr double least_room_mm = 50.0;  ///< of a line that is worth measuring
constexpr double run_up_mm = 1.0, run_up_rad = 0.0175;
constexpr double speed_ratio = 3.0;  ///< of a servo log that is repeated
constexpr double read_s = 5.0;       ///< by hand, where no clock was read
constexpr double prepare_min = 10.0;

bool is_instrument(records::Device device) {
    return device == records::Device::linear || device == records::Device::angle ||
           device == records::Device::point || device == records::Device::axis;
}

bool has(const records::ReadingTable& table, records::Device device) {
    return std::any_of(table.rows.begin(), table.rows.end(),
                       [&](const records::Reading& r) { return r.device == device; });
}

bool logs_axes(const records::ReadingTable& table) {
    return has(table, records::Device::axis);
}

/// "laser lines", "points": what is read again.
std::string readings_of(const records::ReadingTable& table) {
    if (logs_axes(table)) return "the recorded moves";
    if (has(table, records::Device::point)) return "the points";
    return "the lines";
}

/// The rows to repeat, without what was read: those of instruments, and moves between them.
records::ReadingTable rows_again(const records::ReadingTable& table) {
    records::ReadingTable again = thinned(table, enough_rows).value_or(table);
    std::erase_if(again.rows, [](const records::Reading& r) {
        return r.device != records::Device::none && !is_instrument(r.device);
    });
    for (records::Reading& row : again.rows) {
        row.test = "again " + row.test;
        row.value_mm.reset();
    }
    return again;
}

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

/// What all repeats start from.
struct Again {
    const setup::Setup& setup;
    records::ReadingTable table;
    double start_s;
};

Measurement repeat(const Again& again, std::string name, std::string text,
                   records::ReadingTable table) {
    table.path = "measurement " + name;
    Measurement m{std::move(name), std::move(text), "", std::move(table)};
    m.minutes = prepare_min + duration_s(m.table) / 60.0;
    start_at(m.table, again.start_s);
    return m;
}

/// The axes that move in the rows of each test.
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

/// A step of an axis at rest to a parallel line, within its travel; 0 without room.
double step_aside_mm(const kinematics::AxisGeometry& axis, double at_mm) {
    const double up = axis.max ? std::min(beside_mm, *axis.max - at_mm) : beside_mm;
    const double down = axis.min ? std::min(beside_mm, at_mm - *axis.min) : beside_mm;
    const double step = up >= down ? up : -down;
    return std::abs(step) < least_room_mm ? 0.0 : std::trunc(step);
}

/// The tests in which an axis rests, on lines a step of that axis aside.
records::ReadingTable parallel_lines(const Again& again, const kinematics::AxisGeometry& axis) {
    const auto moving = moving_axes(again.table);
    const std::string& name = again.table.names[axis.axis];
    records::ReadingTable table = again.table;
    table.rows.clear();
    for (records::Reading row : again.table.rows) {
        const std::vector<Axis>& own = moving.at(row.test);
        const double step = step_aside_mm(axis, row.commanded[axis.axis]);
        if (step == 0.0 || std::find(own.begin(), own.end(), axis.axis) != own.end()) continue;
        row.commanded[axis.axis] += step;
        row.point_W_mm.reset();
        row.test += " " + name + " aside";
        table.rows.push_back(std::move(row));
    }
    return table;
}

/// Lines beside those of the present readings, one for each axis that rests; and all of them,
/// because an angle about one axis and one about another may look alike on a single line.
void add_parallel_lines(const Again& again, std::vector<Measurement>& list) {
    records::ReadingTable all = again.table;
    all.rows.clear();
    std::string names;
    std::size_t count = 0;
    for (const kinematics::AxisGeometry& axis : again.setup.machine.chain.axes()) {
        if (axis.rotary) continue;
        records::ReadingTable table = parallel_lines(again, axis);
        if (table.rows.empty()) continue;
        const std::string& name = again.table.names[axis.axis];
        double later_s = 0.0;
        if (!all.rows.empty()) later_s = all.rows.back().time_s - table.rows.front().time_s;
        for (records::Reading row : table.rows) {
            row.time_s += later_s;
            all.rows.push_back(std::move(row));
        }
        names += (count++ ? ", then with " : "with ") + name;
        list.push_back(repeat(again, "parallel_" + name,
                              fmt::format("take {} again with {} up to {:.0f} mm aside",
                                          readings_of(again.table), name, beside_mm),
                              std::move(table)));
    }
    if (count < 2) return;
    list.push_back(repeat(again, "parallel_all",
                          fmt::format("take {} again {}, each up to {:.0f} mm aside",
                                      readings_of(again.table), names, beside_mm),
                          std::move(all)));
}

/// The target on the tool further from the spindle nose: one of its own. A stage, a telescope and
/// an arm have no spindle.
void add_longer_tool(const Again& again, std::vector<Measurement>& list) {
    const kinematics::Chain& chain = again.setup.machine.chain;
    if (!chain.find(Axis::X) || !chain.find(Axis::Y) || !chain.find(Axis::Z)) return;
    if (!has(again.table, records::Device::linear) && !has(again.table, records::Device::point))
        return;
    setup::Setup setup = again.setup;
    bool any = false;
    for (setup::Artefact& target : setup.artefacts)
        if (target.kind == setup::Artefact::Kind::target && target.tool_S_mm) {
            target.tool_S_mm->z() -= lower_mm;
            any = true;
        }
    if (!any) return;
    Measurement m = repeat(again, "longer_tool",
                           fmt::format("take {} again with the target {:.0f} mm further from the "
                                       "spindle nose (in the setup a target of its own)",
                                       readings_of(again.table), lower_mm),
                           again.table);
    for (records::Reading& row : m.table.rows) row.point_W_mm.reset();
    m.setup = std::move(setup);
    list.push_back(std::move(m));
}

/// Every reading twice, after a short run-up from below and from above.
void add_both_sides(const Again& again, std::vector<Measurement>& list) {
    const auto moving = moving_axes(again.table);
    records::ReadingTable table = again.table;
    table.rows.clear();
    for (const records::Reading& row : again.table.rows) {
        if (row.device == records::Device::none) continue;
        for (const double side : {-1.0, 1.0}) {
            records::Reading before = row;
            before.device = records::Device::none;
            before.feature.clear();
            for (const Axis axis : moving.at(row.test))
                before.commanded[axis] +=
                    side * (table.names.is_rotary(axis) ? run_up_rad : run_up_mm);
            table.rows.push_back(before);
            table.rows.push_back(row);
        }
    }
    list.push_back(repeat(again, "both_sides",
                          fmt::format("take {} again, every place from below and from above",
                                      readings_of(again.table)),
                          std::move(table)));
}

/// One place more between neighbours of a test, at an uneven part so that it shows aliases.
void add_denser(const Again& again, std::vector<Measurement>& list) {
    constexpr double part = 0.382;
    records::ReadingTable table = again.table;
    table.rows.clear();
    const records::Reading* last = nullptr;
    for (const records::Reading& row : again.table.rows) {
        if (last && last->test == row.test && last->device == row.device &&
            row.device != records::Device::none) {
            records::Reading between = row;
            for (const Axis axis : table.axes)
                between.commanded[axis] =
                    last->commanded[axis] + part * (row.commanded[axis] - last->commanded[axis]);
            between.time_s = 0.5 * (last->time_s + row.time_s);
            between.point_W_mm.reset();
            table.rows.push_back(between);
        }
        table.rows.push_back(row);
        last = &row;
    }
    list.push_back(repeat(again, "denser",
                          fmt::format("take {} again, with a place more between each two, not in "
                                      "the middle",
                                      readings_of(again.table)),
                          std::move(table)));
}

void add_reversed(const Again& again, std::vector<Measurement>& list) {
    records::ReadingTable table = again.table;
    std::reverse(table.rows.begin(), table.rows.end());
    const double end = table.rows.front().time_s;
    for (records::Reading& row : table.rows) row.time_s = end - row.time_s;
    list.push_back(repeat(again, "reversed",
                          fmt::format("take {} again in reverse order", readings_of(again.table)),
                          std::move(table)));
}

/// A servo log at a third and at three times the speed.
void add_speeds(const Again& again, std::vector<Measurement>& list) {
    records::ReadingTable both = again.table;
    both.rows.clear();
    double time_s = 0.0;
    for (const double speed : {1.0 / speed_ratio, speed_ratio}) {
        const double first = again.table.rows.front().time_s;
        double last = time_s;
        for (records::Reading row : again.table.rows) {
            row.test += speed < 1.0 ? " slow" : " fast";
            row.feed_mm_min *= speed;
            if (row.velocity_mm_s) *row.velocity_mm_s *= speed;
            if (row.acceleration_mm_s2) *row.acceleration_mm_s2 *= speed * speed;
            row.time_s = last = time_s + (row.time_s - first) / speed;
            both.rows.push_back(std::move(row));
        }
        time_s = last + 60.0;
    }
    list.push_back(repeat(again, "speeds",
                          fmt::format("take {} again at a third of the speed and at three times "
                                      "the speed",
                                      readings_of(again.table)),
                          std::move(both)));
}

}  // namespace

std::vector<Measurement> repeated_measurements(const setup::Setup& setup,
                                               const records::ReadingTable& table, double start_s) {
    std::vector<Measurement> list;
    const Again again{setup, rows_again(table), start_s};
    if (std::none_of(again.table.rows.begin(), again.table.rows.end(),
                     [](const records::Reading& r) { return is_instrument(r.device); }))
        return list;
    if (logs_axes(again.table)) {
        add_speeds(again, list);
        return list;
    }
    add_parallel_lines(again, list);
    add_longer_tool(again, list);
    add_both_sides(again, list);
    add_denser(again, list);
    add_reversed(again, list);
    return list;
}

}  // namespace trunnion::diagnosis

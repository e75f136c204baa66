#include "diagnosis/advice/measurement_repeats.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "diagnosis/advice/measurement_lines.h"
#include "diagnosis/prepare/thinning.h"

namespace trunnion::diagnosis {
namespace {

constexpr std::size_t enough_rows = 1000;
constexpr double lower_mm = 100.0;  ///< of a target further from the spindle nose
constexpr double run_up_mm = 1.0, run_up_rad = 0.0175;
constexpr double speed_ratio = 3.0;  ///< of a servo log that is repeated

bool is_instrument(records::Device device) {
    return device == records::Device::linear || device == records::Device::angle ||
           device == records::Device::point || device == records::Device::axis;
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

/// The target on the tool further from the spindle nose: one of its own. A stage, a telescope and
/// an arm have no spindle.
void add_longer_tool(const Again& again, std::vector<Measurement>& list) {
    const kinematics::Chain& chain = again.setup.machine.chain;
    if (!chain.find(Axis::X) || !chain.find(Axis::Y) || !chain.find(Axis::Z)) return;
    if (!reads(again.table, records::Device::linear) && !reads(again.table, records::Device::point))
        return;
    setup::Setup setup = again.setup;
    std::string places;
    for (setup::Artefact& target : setup.artefacts)
        if (target.kind == setup::Artefact::Kind::target && target.tool_S_mm) {
            Vector3& at = *target.tool_S_mm;
            at.z() -= lower_mm;
            places += fmt::format("{}in place of {}: tool_mm = [{:g}, {:g}, {:g}]",
                                  places.empty() ? "" : ", ", target.name, at.x(), at.y(), at.z());
        }
    if (places.empty()) return;
    Measurement m = repeat_of(
        again, "longer_tool",
        fmt::format("take {} again with the target {:.0f} mm further from the spindle nose, a "
                    "target of its own in the setup ({}), imported with --with "
                    "feature=NAME",
                    readings_of(again.table), lower_mm, places),
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
    list.push_back(
        repeat_of(again, "both_sides",
                  fmt::format("take {} again, every place from below and from above, "
                              "with a run-up of {:.0f} mm or {:.0f} deg",
                              readings_of(again.table), run_up_mm, deg_from_rad(run_up_rad)),
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
    list.push_back(
        repeat_of(again, "denser",
                  fmt::format("take {} again, with a place more between each two, not in "
                              "the middle: {:.0f} % of the way",
                              readings_of(again.table), 100.0 * part),
                  std::move(table)));
}

void add_reversed(const Again& again, std::vector<Measurement>& list) {
    records::ReadingTable table = again.table;
    std::reverse(table.rows.begin(), table.rows.end());
    const double end = table.rows.front().time_s;
    for (records::Reading& row : table.rows) row.time_s = end - row.time_s;
    list.push_back(repeat_of(again, "reversed",
                             fmt::format("take {} again in reverse order, the last place first",
                                         readings_of(again.table)),
                             std::move(table)));
}

/// The same places read by another instrument, whose gain is its own.
void add_second_instrument(const Again& again, std::vector<Measurement>& list) {
    if (!reads(again.table, records::Device::linear) && !reads(again.table, records::Device::point))
        return;
    list.push_back(repeat_of(again, "second_instrument",
                             fmt::format("take {} again with a second instrument, {}{}",
                                         readings_of(again.table), import_of_second_instrument,
                                         reads(again.table, records::Device::point)
                                             ? ""
                                             : " (readings that name none are the first one's)"),
                             again.table));
    list.back().other_instrument = true;
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
    list.push_back(repeat_of(again, "speeds",
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
    add_other_axes(again, list);
    add_second_instrument(again, list);
    return list;
}

}  // namespace trunnion::diagnosis

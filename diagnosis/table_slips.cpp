#include "diagnosis/table_slips.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>

#include "base/units.h"

namespace trunnion::diagnosis {
namespace {

constexpr double mm_per_inch = 25.4;

/// A reading whose device reads along, or about, a direction.
bool is_along(const records::Reading& row) {
    return row.device != records::Device::none && row.direction_M.norm() > 0.0;
}

void add_directions(std::vector<TableSlip>& list) {
    constexpr const char* names[] = {"dir_x", "dir_y", "dir_z"};
    for (int a = 0; a < 3; ++a) {
        for (int b = a + 1; b < 3; ++b)
            list.push_back(
                {fmt::format("the columns {} and {} seem to be exchanged", names[a], names[b]),
                 [a, b](records::Reading& row) {
                     if (is_along(row)) std::swap(row.direction_M(a), row.direction_M(b));
                 }});
        list.push_back({fmt::format("the sign of {} seems to be turned", names[a]),
                        [a](records::Reading& row) {
                            if (is_along(row)) row.direction_M(a) = -row.direction_M(a);
                        }});
    }
    list.push_back(
        {"the signs of dir_x, dir_y and dir_z seem to be turned", [](records::Reading& row) {
             if (is_along(row)) row.direction_M = -row.direction_M;
         }});
}

void add_values(const records::ReadingTable& table, std::vector<TableSlip>& list) {
    using enum records::Device;
    const auto scaled = [](records::Device device, double factor) {
        return [device, factor](records::Reading& row) {
            if (row.device == device && row.value_mm) row.value_mm = factor * *row.value_mm;
        };
    };
    for (const records::Device device : {sphere, touch, ballbar, linear, angle, point, axis}) {
        if (std::none_of(table.rows.begin(), table.rows.end(),
                         [&](const records::Reading& row) { return row.device == device; }))
            continue;
        const std::string_view name = records::name_of(device);
        list.push_back({fmt::format("the values of device {} seem to have the wrong sign", name),
                        scaled(device, -1.0)});
        if (device == angle || device == axis) continue;
        const auto add_unit = [&](const char* unit, double factor) {
            list.push_back(
                {fmt::format("the values of device {} seem to be in {}, not in mm", name, unit),
                 scaled(device, factor), factor, device, true});
        };
        add_unit("inches", mm_per_inch);
        add_unit("m", 1000.0);
        add_unit("um", 1e-3);
    }
}

std::string column_of(const records::ReadingTable& table, Axis axis) {
    std::string name = table.names[axis];
    for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return name + (table.names.is_rotary(axis) ? "_deg" : "_mm");
}

TableSlip scaled_axis(std::string words, Axis axis, double factor) {
    return {std::move(words),
            [axis, factor](records::Reading& row) { row.commanded[axis] *= factor; }, 1.0,
            records::Device::none, factor != -1.0};
}

void add_positions(const records::ReadingTable& table, std::vector<TableSlip>& list) {
    std::vector<Axis> linear;
    for (const Axis axis : table.axes) {
        const std::string name = column_of(table, axis);
        const bool turns = table.names.is_rotary(axis);
        if (!turns) linear.push_back(axis);
        list.push_back(
            scaled_axis(fmt::format("the sign of {} seems to be turned", name), axis, -1.0));
        if (turns)
            list.push_back(scaled_axis(fmt::format("the column {} seems to hold radians", name),
                                       axis, deg_from_rad(1.0)));
    }
    for (std::size_t a = 0; a < table.axes.size(); ++a)
        for (std::size_t b = a + 1; b < table.axes.size(); ++b) {
            const Axis first = table.axes[a], second = table.axes[b];
            if (table.names.is_rotary(first) != table.names.is_rotary(second)) continue;
            list.push_back({fmt::format("the columns {} and {} seem to be exchanged",
                                        column_of(table, first), column_of(table, second)),
                            [first, second](records::Reading& row) {
                                std::swap(row.commanded[first], row.commanded[second]);
                            }});
        }
    list.push_back({"the positions of the linear axes seem to be in inches, not in mm",
                    [linear](records::Reading& row) {
                        for (const Axis axis : linear) row.commanded[axis] *= mm_per_inch;
                    },
                    1.0, records::Device::none, true});
}

}  // namespace

std::vector<TableSlip> slips_of(const records::ReadingTable& table) {
    std::vector<TableSlip> list;
    if (std::any_of(table.rows.begin(), table.rows.end(), is_along)) add_directions(list);
    add_values(table, list);
    add_positions(table, list);
    return list;
}

records::ReadingTable undone(const TableSlip& slip, records::ReadingTable table) {
    for (records::Reading& row : table.rows) slip.undo(row);
    return table;
}

}  // namespace trunnion::diagnosis

// Derives the parameters that a control with true knowledge of the machine would have.
#include <algorithm>
#include <cmath>

#include "base/alarm.h"
#include "offsets/axis_numbers.h"
#include "offsets/pivot_parameters.h"
#include "setup/setup.h"

namespace trunnion::setup {

namespace {

std::vector<Axis> control_order(const kinematics::Machine& machine) {
    std::vector<Axis> order;
    for (const kinematics::AxisGeometry& axis : machine.chain.axes())
        if (is_letter(axis)) order.push_back(axis.axis);
    return order;
}

std::vector<kinematics::AxisGeometry> rotaries(const std::vector<kinematics::AxisGeometry>& side) {
    std::vector<kinematics::AxisGeometry> found;
    for (const kinematics::AxisGeometry& axis : side)
        if (axis.rotary) found.push_back(axis);
    return found;
}

bool rotary_carries_linear(const std::vector<kinematics::AxisGeometry>& side) {
    const auto first = std::find_if(side.begin(), side.end(), [](auto& a) { return a.rotary; });
    return std::any_of(first, side.end(), [](auto& a) { return !a.rotary; });
}

offsets::PivotAxis pivot_axis(const kinematics::AxisGeometry& axis) {
    offsets::PivotAxis out;
    out.axis = axis.axis;
    out.line = axis.direction.normalized();
    out.min_rad = axis.min;
    out.max_rad = axis.max;
    return out;
}

offsets::PivotParameters pivot_of(const std::vector<kinematics::AxisGeometry>& table,
                                  const std::vector<kinematics::AxisGeometry>& tool) {
    offsets::PivotParameters pivot;
    if (table.size() == 2) {
        pivot.unit = offsets::MechanicalUnit::table_table;
        pivot.first = pivot_axis(table[0]);
        pivot.second = pivot_axis(table[1]);
        pivot.table_point_mm = table[0].point_mm;
        pivot.table_offset_mm = table[1].point_mm - table[0].point_mm;
        return pivot;
    }
    pivot.first = pivot_axis(tool[0]);
    pivot.tool_offset_mm = tool[0].point_mm;  // S coincides with M when all axes are at zero
    if (tool.size() == 2) {
        pivot.unit = offsets::MechanicalUnit::tool_tool;
        pivot.second = pivot_axis(tool[1]);
        pivot.tool_second_offset_mm = tool[0].point_mm - tool[1].point_mm;
        return pivot;
    }
    pivot.unit = offsets::MechanicalUnit::mixed;
    pivot.second = pivot_axis(table[0]);
    pivot.table_point_mm = table[0].point_mm;
    return pivot;
}

/// The linear axes (from, to) such that a + rotation turns + of the first into + of the second;
/// empty for an inclined axis.
std::optional<std::array<int, 2>> turned_plane(const Vector3& direction) {
    for (int i = 0; i < 3; ++i) {
        if (1.0 - std::abs(direction[i]) > 1e-12) continue;
        const int from = (i + 1) % 3, to = (i + 2) % 3;
        return direction[i] > 0.0 ? std::array{from, to} : std::array{to, from};
    }
    return std::nullopt;
}

}  // namespace

std::string derive_pivot_parameters(const kinematics::Machine& machine,
                                    offsets::Parameters& parameters) {
    const auto table = rotaries(machine.chain.work);
    const auto tool = rotaries(machine.chain.tool);
    if (table.size() + tool.size() != 2) return "the machine has not two rotary axes";
    const auto axes = machine.chain.axes();
    if (!std::all_of(axes.begin(), axes.end(), kinematics::is_letter))
        return "an axis has a name that no NC word addresses";
    if (rotary_carries_linear(machine.chain.work) || rotary_carries_linear(machine.chain.tool))
        return "a rotary axis carries a linear one";
    const offsets::PivotParameters pivot = pivot_of(table, tool);
    if (pivot.first.line.cross(pivot.second.line).norm() < 0.01)
        return "its two rotary axes are parallel: they turn the tool to no other side";
    offsets::Parameters derived;
    try {
        offsets::encode_pivot(pivot, derived, control_order(machine));
    } catch (const InputError& error) {
        return error.message;
    }
    for (const auto& [number, parameter] : derived.entry)
        parameters.entry.try_emplace(number, parameter);
    return {};
}

void derive_fixture_groups(const kinematics::Machine& machine, offsets::Parameters& parameters) {
    for (int number = 7580; number <= 7588; ++number)
        if (parameters.find(number)) return;
    const auto order = control_order(machine);
    auto table = rotaries(machine.chain.work);
    std::reverse(table.begin(), table.end());
    offsets::Parameters derived;
    int number = 7580;
    // Head axes carry no fixture: no group turns its offset.
    if (table.empty() && !rotaries(machine.chain.tool).empty()) derived.set(number, 0);
    for (const kinematics::AxisGeometry& axis : table) {
        if (number > 7586) break;
        if (!is_letter(axis)) continue;
        // No group can describe rotation about an inclined axis: G54.2 then raises alarm 5459.
        const auto plane = turned_plane(axis.direction.normalized());
        derived.set(number, offsets::number_of_axis(axis.axis, order));
        for (const std::size_t i : {0U, 1U})
            derived.set(number + 1 + static_cast<int>(i),
                        plane ? offsets::number_of_axis(
                                    all_axes[static_cast<std::size_t>((*plane)[i])], order)
                              : 0);
        number += 3;
    }
    for (const auto& [key, parameter] : derived.entry) parameters.entry[key] = parameter;
}

}  // namespace trunnion::setup

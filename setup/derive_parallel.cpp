// Parameter 1022: linear axes parallel to X, Y and Z.
#include "setup/setup.h"

namespace trunnion::setup {
namespace {

/// 1, 2, 3 for an axis that moves the tool along +X, +Y, +Z relative to the workpiece; 0 for any
/// other direction.
int basic_direction(const Vector3& moves_tool) {
    for (int i = 0; i < 3; ++i)
        if ((moves_tool - Vector3::Unit(i)).norm() < 1e-9) return i + 1;
    return 0;
}

/// Values for one side. An axis carried by a rotary axis rotates with it and is parallel to none.
void number_side(const std::vector<kinematics::AxisGeometry>& side, double sign,
                 std::array<int, axis_count>& value) {
    bool carried = false;
    for (const kinematics::AxisGeometry& axis : side) {
        carried |= axis.rotary;
        if (!axis.rotary && !carried)
            value[index_of(axis.axis)] = basic_direction(sign * axis.direction);
    }
}

}  // namespace

std::string derive_parallel_axes(const kinematics::Machine& machine,
                                 offsets::Parameters& parameters) {
    const auto is_extra = [](Axis axis) { return index_of(axis) >= index_of(Axis::U); };
    std::array<int, axis_count> direction{};
    number_side(machine.chain.tool, 1.0, direction);
    number_side(machine.chain.work, -1.0, direction);
    offsets::Parameter derived;
    std::string alone;
    bool extra = false;
    int number = 0;
    for (const kinematics::AxisGeometry& axis : machine.chain.axes()) {
        if (!is_letter(axis)) continue;  // no NC word addresses it
        const int basic = direction[index_of(axis.axis)];
        const bool parallel = is_extra(axis.axis) && basic != 0;
        derived.by_axis[++number] = basic + (parallel ? 4 : 0);
        extra |= is_extra(axis.axis);
        if (is_extra(axis.axis) && basic == 0) alone += (alone.empty() ? "" : ", ") + axis.name;
    }
    if (!extra || parameters.find(1022)) return {};
    parameters.entry[1022] = derived;
    return alone;
}

}  // namespace trunnion::setup

#include "setup/control_axes.h"

#include <algorithm>

namespace trunnion::setup {

namespace {

bool has_backlash(const Setup& setup, const std::string& axis) {
    return std::any_of(setup.effects.begin(), setup.effects.end(),
                       [&](const EffectSetting& e) { return e.name == axis + ".backlash"; });
}

bool has_motion_error(const Setup& setup, Axis axis) {
    const auto& motion = setup.machine.errors.axis[index_of(axis)].motion;
    return std::any_of(motion.begin(), motion.end(), [](const auto& e) { return !e.is_zero(); });
}

}  // namespace

std::vector<kinematics::AxisGeometry> control_axes(const Setup& setup) {
    std::vector<kinematics::AxisGeometry> axes = setup.machine.chain.axes();
    std::erase_if(axes, [](const auto& axis) { return !is_letter(axis); });
    axes.insert(axes.end(), setup.auxiliary.begin(), setup.auxiliary.end());
    return axes;
}

std::vector<kinematics::AxisGeometry> all_machine_axes(const Setup& setup) {
    std::vector<kinematics::AxisGeometry> axes = setup.machine.chain.axes();
    axes.insert(axes.end(), setup.auxiliary.begin(), setup.auxiliary.end());
    return axes;
}

std::vector<offsets::AxisCompensation> compensated_axes(const Setup& setup) {
    std::vector<Axis> order;
    for (const kinematics::AxisGeometry& axis : control_axes(setup)) order.push_back(axis.axis);
    return offsets::decode_compensation(setup.stores.parameters, order);
}

std::string overcompensated_axes(const Setup& setup) {
    std::string letters;
    for (const offsets::AxisCompensation& one : compensated_axes(setup)) {
        const kinematics::AxisGeometry* axis = setup.machine.chain.find(one.axis);
        if (!axis) continue;  // an auxiliary axis carries nothing
        const bool backlash = one.backlash != 0.0 && !has_backlash(setup, axis->name);
        const bool pitch = !one.at.empty() && !has_motion_error(setup, one.axis);
        if (backlash || pitch) letters += (letters.empty() ? "" : ", ") + axis->name;
    }
    return letters;
}

}  // namespace trunnion::setup

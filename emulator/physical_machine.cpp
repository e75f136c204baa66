#include "emulator/physical_machine.h"

#include <algorithm>

#include "positioning/rotary_transform.h"

namespace trunnion {

PhysicalMachine::PhysicalMachine(const Machine& machine, EffectModels effects)
    : model_(machine), effects_(std::move(effects)) {
    for (std::size_t i = 0; i < axis_count; ++i)
        half_backlash_[i] = 0.5 * machine.errors.axis[i].backlash;
}

PhysicalState PhysicalMachine::at(const AxisSample& sample, const Contact& contact) const {
    PhysicalState state;
    for (std::size_t i = 0; i < axis_count; ++i)
        state.extra.axis.value[i] = half_backlash_[i] * sample.travel[i];
    for (const auto& effect : effects_) effect->perturb(sample, contact, state.extra);
    state.poses = model_.poses(sample.position, state.extra, spindle_angle(sample));
    return state;
}

namespace {

/// As offset T of the setup says; 0 for a tool that it does not know.
double tool_length_mm(const Setup& setup, int tool) {
    const auto& tools = setup.stores.tools.tool;
    const auto n = static_cast<std::size_t>(std::max(0, tool));
    return n == 0 || n >= tools.size() ? 0.0 : tools[n].length_mm();
}

}  // namespace

Vector3 physical_tip_S(const Setup& setup, const AxisMove& move, double extension_mm) {
    if (setup.probe && setup.probe->tool != 0 && move.tool == setup.probe->tool)
        return setup.probe->tip_with(extension_mm);
    const double length_mm = tool_length_mm(setup, move.tool);
    if (length_mm == 0.0) return -move.tool_vector_mm;
    const Vector3 direction =
        move.transform ? move.transform->pivot().tool_direction : Vector3::UnitZ();
    return -length_mm * direction;
}

Contact tip_contact(const Setup& setup, const AxisMove& move) {
    Contact contact;
    contact.tip = true;
    contact.stylus =
        !setup.probe || setup.probe->tool == 0 || move.tool == 0 || move.tool == setup.probe->tool;
    return contact;
}

Vector3 physical_tip_W(const PhysicalState& state, const Vector3& tip_S_mm) {
    return state.poses.pose_MW.inverse() *
           (state.poses.pose_MS * (tip_S_mm + state.extra.tip_shift_mm));
}

}  // namespace trunnion

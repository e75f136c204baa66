#include "emulator/physical_machine.h"

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
    state.poses = model_.poses(sample.position, state.extra);
    return state;
}

Vector3 physical_tip_S(const Setup& setup, const AxisMove& move, double extension_mm) {
    if (setup.probe && setup.probe->tool != 0 && move.tool == setup.probe->tool)
        return setup.probe->tip_with(extension_mm);
    return -move.tool_vector_mm;
}

Vector3 physical_tip_W(const PhysicalState& state, const Vector3& tip_S_mm) {
    return state.poses.pose_MW.inverse() *
           (state.poses.pose_MS * (tip_S_mm + state.extra.tip_shift_mm));
}

}  // namespace trunnion

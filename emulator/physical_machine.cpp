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

}  // namespace trunnion

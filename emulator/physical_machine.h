// The machine as it stands in the shop: geometry with its errors, backlash and effects.
#pragma once

#include "emulator/replay.h"
#include "kinematics/forward.h"

namespace trunnion {

/// Where the bodies and the device are at one sample.
struct PhysicalState {
    MachinePose poses;
    Perturbation extra;  ///< what effects add: the device reads tip, work and reading shifts here
};

class PhysicalMachine {
  public:
    PhysicalMachine(const Machine& machine, EffectModels effects);

    PhysicalState at(const AxisSample& sample, const Contact& contact) const;

  private:
    ForwardModel model_;
    std::array<double, axis_count> half_backlash_{};
    EffectModels effects_;
};

}  // namespace trunnion

// The machine as it stands in the shop: geometry with its errors, backlash and effects.
#pragma once

#include "emulator/replay.h"
#include "kinematics/forward.h"
#include "motion/motion.h"

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

/// The physical tip in S during a move: the stylus when the setup's probe is in the spindle, else a
/// tool just as long as the control believes (the gauge point when no length is in force).
Vector3 physical_tip_S(const Setup& setup, const AxisMove& move, double extension_mm = 0.0);

/// Where that tip is in W, effects included.
Vector3 physical_tip_W(const PhysicalState& state, const Vector3& tip_S_mm);

}  // namespace trunnion

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

/// The physical tip in S during a move: the stylus when the setup's probe is in the spindle, else
/// tool T, as long as offset T of the setup says, whatever H is in force. A tool that the setup
/// does not know (none called, no length) is as long as the control believes. It points along Z of
/// S, or as 19697 says: [machine] has no key for the spindle's direction.
Vector3 physical_tip_S(const Setup& setup, const AxisMove& move, double extension_mm = 0.0);

/// What effects of the tool ask for when no device reads but its tip is wanted.
Contact tip_contact(const Setup& setup, const AxisMove& move);

/// Where that tip is in W, effects included.
Vector3 physical_tip_W(const PhysicalState& state, const Vector3& tip_S_mm);

}  // namespace trunnion

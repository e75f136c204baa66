// The door through which every prediction goes: axis sample in, reading out. Noise-free and smooth.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "emulator/setup.h"
#include "kinematics/machine.h"
#include "records/readings.h"

namespace trunnion {

/// The physical model of one effect that is switched on: what it adds at one sample. Written in the
/// effects room, one small file each; the emulator only calls it.
class EffectModel {
  public:
    virtual ~EffectModel() = default;
    virtual void perturb(const AxisSample& sample, Perturbation& out) const = 0;
};

}  // namespace trunnion

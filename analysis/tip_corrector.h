// Axis positions at which the physical tip stands where the control believed it to be.
#pragma once

#include "emulator/path_sampler.h"
#include "emulator/physical_machine.h"

namespace trunnion {

class TipCorrector {
  public:
    /// The tool is as long as the control believes. Throws InputError when it has no X, Y or Z
    /// axis.
    TipCorrector(const Setup& setup, const EffectModels& effects);

    /// Believed tip in W at s of a move: what the program means.
    Vector3 meant_W(const AxisMove& move, double s) const;
    /// Physical tip in W when the axes stand at q instead of where the path has them at s.
    Vector3 true_W(const PathSampler& path, double s, const AxisPositions& q) const;
    /// X Y Z changed so that true is meant, to 1e-9 mm.
    AxisPositions corrected(const PathSampler& path, double s) const;

  private:
    Machine nominal_;
    PhysicalMachine machine_;
};

}  // namespace trunnion

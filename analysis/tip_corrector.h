// Axis positions at which the physical tool stands where and as the control believed it to.
#pragma once

#include "emulator/path_sampler.h"
#include "emulator/physical_machine.h"
#include "emulator/trace.h"

namespace trunnion {

class TipCorrector {
  public:
    /// The tool is as long as the control believes. `largest_turn_rad`: no rotary axis is taken
    /// further than this from its commanded angle for the sake of the tool's direction (near the
    /// singular direction a tilt of a few urad would ask for any angle); 0: never turned. Throws
    /// InputError when the machine has no X, Y or Z axis.
    TipCorrector(const Setup& setup, const EffectModels& effects, double largest_turn_rad = 0.0);

    /// True when the direction is corrected too: tool centre point control or turning rotaries, on
    /// a control that knows two of them. Where rotaries stand the program may have clamped them.
    bool turns_tool(const AxisMove& move) const;

    /// Believed tip and direction in W at s of a move: what the program means.
    BelievedTool meant(const AxisMove& move, double s) const;
    /// Physical tip and direction in W when the axes stand at q instead of where the path has them
    /// at s.
    BelievedTool truth(const PathSampler& path, double s, const AxisPositions& q) const;
    /// X Y Z changed so that the true tip is the meant one, to 1e-9 mm, and the rotaries, where
    /// `turns_tool`, so that the direction is.
    AxisPositions corrected(const PathSampler& path, double s) const;

  private:
    void turn(const PathSampler& path, double s, const BelievedTool& meant, AxisPositions& q) const;

    Machine nominal_;
    PhysicalMachine machine_;
    double largest_turn_rad_;
};

/// Angle between two unit vectors, rad; exact for small ones.
double angle_between(const Vector3& a, const Vector3& b);

}  // namespace trunnion

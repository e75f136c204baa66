// Axis positions at which the physical tool stands where and as the control believed it to.
#pragma once

#include "compensation/path_stretches.h"
#include "emulator/path_sampler.h"
#include "emulator/tool_tip.h"
#include "emulator/trace.h"

namespace trunnion::compensation {

/// Where to send the axes.
struct Correction {
    AxisPositions to;
    Travel travel{};  ///< with which they arrive
    /// Axes that cannot get where they should without turning round first (a gap lies between), and
    /// where they should be.
    std::array<bool, axis_count> held{};
    AxisPositions wanted;
};

class TipCorrector {
  public:
    /// `setup` must outlive the corrector. The tool is as long as the control believes.
    /// `largest_turn_rad`: no rotary axis is taken further than this from its commanded angle for
    /// the sake of the tool's direction (near the singular direction a tilt of a few urad would ask
    /// for any angle); 0: never turned. `decimals` of the words that will say where to go. Throws
    /// InputError when the machine has no X, Y or Z axis.
    TipCorrector(const setup::Setup& setup, const emulator::EffectModels& effects,
                 double largest_turn_rad = 0.0, int decimals = 6);

    /// True when the direction is corrected too: tool centre point control or turning rotaries, on
    /// a control that knows two of them. Where rotaries stand the program may have clamped them.
    bool turns_tool(const motion::AxisMove& move) const;

    /// Believed tip and direction in W at s of a move: what the program means.
    emulator::BelievedTool meant(const motion::AxisMove& move, double s) const;
    /// Physical tip and direction in W at s.
    emulator::BelievedTool truth(const emulator::PathSampler& path, double s) const;
    /// Where to go from where and as `written` stands, so that the true tip is the meant one (to
    /// 1e-9 mm) and, where `turns_tool`, the direction too. Backlash and its kin follow the travel
    /// of the axes on their corrected way; what is wanted of an axis may lie inside its gap: then
    /// it is held on the nearer side of it. `stretch` holds s and tells how the program moves.
    Correction corrected(const emulator::PathSampler& path, const PathStretch& stretch, double s,
                         const records::TravelHistory& written) const;

  private:
    using Held = std::array<std::optional<double>, axis_count>;  ///< positions of axes that wait

    emulator::BelievedTool truth(const emulator::PathSampler& path, double s,
                                 const AxisPositions& q, const Travel& travel) const;
    void turn(const emulator::PathSampler& path, double s, const emulator::BelievedTool& meant,
              const Travel& travel, const Held& held, AxisPositions& q) const;
    AxisPositions solved(const emulator::PathSampler& path, double s, const Travel& travel,
                         const Held& held) const;
    double digit(std::size_t axis) const;
    Travel arrival(const AxisPositions& q, const records::TravelHistory& written) const;

    const setup::Setup& setup_;
    kinematics::Machine nominal_;
    emulator::Observer machine_;
    double largest_turn_rad_, digit_mm_;
};

/// Angle between two unit vectors, rad; exact for small ones.
double angle_between(const Vector3& a, const Vector3& b);

}  // namespace trunnion::compensation

// Axis positions at which the physical tool has the believed position and direction.
#pragma once

#include "compensation/path_stretches.h"
#include "emulator/path_sampler.h"
#include "emulator/tool_tip.h"
#include "emulator/trace.h"

namespace trunnion::compensation {

/// Target of the axes.
struct Correction {
    AxisPositions to;
    Travel travel{};  ///< direction in which they arrive
    /// Axes that cannot reach the wanted position without reversing first (a gap lies between), and
    /// the wanted positions.
    std::array<bool, axis_count> held{};
    AxisPositions wanted;
};

class TipCorrector {
  public:
    /// `setup` must outlive the corrector. The tool has its believed length. `largest_turn_rad`:
    /// maximum correction of a rotary axis from its commanded angle for the tool direction (near
    /// the singular direction a tilt of a few urad would require arbitrary angles); 0: none.
    /// `decimals` of the words to be written. Throws InputError when the machine has no X, Y or Z
    /// axis.
    TipCorrector(const setup::Setup& setup, const emulator::EffectModels& effects,
                 double largest_turn_rad = 0.0, int decimals = 6);

    /// True when the direction is corrected too: tool centre point control or moving rotary axes,
    /// on a control that knows two of them. Rotary axes at rest may be clamped by the program.
    bool turns_tool(const motion::AxisMove& move) const;

    /// Believed tip and direction in W at s of a move: the intention of the program.
    emulator::BelievedTool meant(const motion::AxisMove& move, double s) const;
    /// Physical tip and direction in W at s.
    emulator::BelievedTool truth(const emulator::PathSampler& path, double s) const;
    /// Axis positions, starting from `written`, that place the physical tip on the believed tip (to
    /// 1e-9 mm) and, where `turns_tool`, the direction too. Backlash and similar effects follow the
    /// travel of the axes on their corrected path. If the wanted position of an axis lies inside
    /// its gap, the axis is held on the nearer side. `stretch` contains s and the directions of
    /// motion of the program.
    Correction corrected(const emulator::PathSampler& path, const PathStretch& stretch, double s,
                         const records::TravelHistory& written) const;

  private:
    using Held = std::array<std::optional<double>, axis_count>;  ///< positions of held axes

    emulator::BelievedTool truth(const emulator::PathSampler& path, double s,
                                 const AxisPositions& q, const Travel& travel) const;
    /// A point of the path, and how the axes get there.
    struct Arrival {
        const emulator::PathSampler& path;
        double s;
        const Travel& travel;
        const Held& held;
    };

    void turn(const Arrival& at, const emulator::BelievedTool& meant, AxisPositions& q) const;
    AxisPositions solved(const Arrival& at) const;
    double digit(std::size_t axis) const;
    Travel arrival(const AxisPositions& q, const records::TravelHistory& written) const;

    const setup::Setup& setup_;
    kinematics::Machine nominal_;
    emulator::Observer machine_;
    double largest_turn_rad_, digit_mm_;
};

/// Angle between two unit vectors, rad; accurate for small angles.
double angle_between(const Vector3& a, const Vector3& b);

}  // namespace trunnion::compensation

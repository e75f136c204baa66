// The physical machine: any serial chain with its errors, forward kinematics only (forward.cpp).
#pragma once

#include <array>
#include <optional>

#include "geometry/axes.h"
#include "geometry/pose.h"
#include "kinematics/chain.h"
#include "kinematics/errors.h"

namespace trunnion::kinematics {

/// Contributions of effects outside `GeometricErrors` to one sample.
struct Perturbation {
    AxisPositions axis;                            ///< added to the commanded positions, mm and rad
    std::array<SmallMotion, axis_count> motion{};  ///< added to the error motion of each axis,
                                                   ///< along and about the carrier's axes
    Vector3 tip_shift_mm = Vector3::Zero();        ///< shift of the tool tip, in S
    Vector3 work_shift_mm = Vector3::Zero();       ///< shift of the artefact, in W
    double reading_mm = 0.0;                       ///< added to the reading itself
};

/// The two ends of the structural loop, seen from the bed.
struct MachinePose {
    Pose pose_MW;  ///< table frame; identity with all axes at zero and no errors
    Pose pose_MS;  ///< spindle frame; without errors and rotary heads a pure shift by (X, Y, Z)
};

/// Angle of the spindle, rad. Empty while the spindle turns: the harmonics of its error motions
/// then average out and only their constants remain.
using SpindleAngle = std::optional<double>;

/// The physical machine. Frames are defined in docs/notation.md. To evaluate one machine many times
/// use ForwardModel (kinematics/forward.h), which prepares the constant parts once.
///
/// At home the frame of each axis coincides with M; it moves with its axis. The errors of an axis
/// act along and about the axes of its carrier's frame. Everything that the axis carries follows
/// them, other slides included (HTM paper of 2022, eq. 20-25). Rotations are exact, not linearised.
/// There are no singular positions: the forward map is defined everywhere.
///
/// Rotary axis R with u = direction, q = point_mm, commanded angle r (rad):
///     x' = q + delta + exp([eps]x) * (delta_m + exp([eps_m]x) * Rot(u, r) * (x - q))
/// Its location errors are delta = (EX0R EY0R EZ0R) and eps = (EA0R EB0R EC0R). Its error motions
/// are delta_m(r) = (EXR EYR EZR) and eps_m(r) = (EAR EBR ECR).
///
/// Linear axis L at l (mm): x' = delta + l * exp([eps]x) u + delta_m + exp([eps_m]x) * x. The
/// location tilt eps inclines the direction of travel only; an inclination of the carriage itself
/// is a constant eps_m. The error motion turns the carriage about the origin of its frame, which is
/// l * u from home. Example: with EBY = 1e-4 on "w b Y X Z t" the tip sinks by 0.03 mm when X moves
/// to 300.
///
/// Spindle at angle r, in S: p' = delta + exp([eps]x) * (delta_m(r) + exp([eps_m(r)]x) * p), with
/// the location errors EX0S.. EB0S and the error motions EXS.. EBS.
struct Machine {
    Chain chain;
    GeometricErrors errors;

    MachinePose poses(const AxisPositions& commanded, SpindleAngle spindle_rad = 0.0) const;
    MachinePose poses(const AxisPositions& commanded, const Perturbation& extra,
                      SpindleAngle spindle_rad = 0.0) const;

    /// The tool tip in W, mm: pose_MW^-1 * pose_MS * tip_S.
    Vector3 tip_W(const AxisPositions& commanded, const Vector3& tip_S_mm,
                  SpindleAngle spindle_rad = 0.0) const;
};

}  // namespace trunnion::kinematics

// The physical machine: any serial chain with its errors, forward only.
#pragma once

#include <array>
#include <optional>

#include "geometry/axes.h"
#include "geometry/pose.h"
#include "kinematics/chain.h"
#include "kinematics/errors.h"

namespace trunnion::kinematics {

/// What effects outside `GeometricErrors` add at one sample.
struct Perturbation {
    AxisPositions axis;                            ///< added to the commanded positions, mm and rad
    std::array<SmallMotion, axis_count> motion{};  ///< added to each axis's error motion, in M axes
    Vector3 tip_shift_mm = Vector3::Zero();        ///< of the tool tip, in S
    Vector3 work_shift_mm = Vector3::Zero();       ///< of the artefact, in W
    double reading_mm = 0.0;                       ///< added to the reading itself
};

/// The two open ends of the structural loop, seen from the bed.
struct MachinePose {
    Pose pose_MW;  ///< table frame: identity when all axes are at zero and there are no errors
    Pose pose_MS;  ///< spindle frame: a pure shift by (X, Y, Z) without errors
};

/// Angle of the spindle, rad; nothing while it turns: then the harmonics of its error motions
/// average out and their constants remain.
using SpindleAngle = std::optional<double>;

/// The physical machine. Frames in docs/notation.md. For many evaluations of one machine use
/// ForwardModel (kinematics/forward.h), which works out once what does not change.
///
/// The frame of each axis lies on M at home and moves with its axis. The errors of an axis are
/// along and about the axes of its carrier's frame, and all that the axis carries follows them,
/// other slides included (HTM paper of 2022, eq. 20-25). Exact rotations everywhere.
///
/// Rotary axis R with u = direction, q = point_mm, commanded r (rad):
///     x' = q + delta + exp([eps]x) * (delta_m + exp([eps_m]x) * Rot(u, r + error) * (x - q))
/// with its location delta = (EX0R EY0R EZ0R), eps = (EA0R EB0R EC0R) and its error motion
/// delta_m(r) = (EXR EYR EZR), eps_m(r) = (EAR EBR ECR).
///
/// Linear axis L at l (mm): x' = delta + l * exp([eps]x) u + delta_m + exp([eps_m]x) * x. Its
/// location tilt leans the direction of travel and nothing else: a constant eps_m is what the
/// carriage itself leans. Its error motion turns about the origin of its frame, l * u from home:
/// with EBY = 1e-4 on "w b Y X Z t" the tip sinks by 0.03 mm when X goes to 300.
///
/// Spindle at angle r, in S: p' = delta + exp([eps]x) * (delta_m(r) + exp([eps_m(r)]x) * p) with
/// its location EX0S.. EB0S and its motions EXS.. EBS.
struct Machine {
    Chain chain;
    GeometricErrors errors;

    MachinePose poses(const AxisPositions& commanded, SpindleAngle spindle_rad = 0.0) const;
    MachinePose poses(const AxisPositions& commanded, const Perturbation& extra,
                      SpindleAngle spindle_rad = 0.0) const;

    /// The tool tip in W: pose_MW^-1 * pose_MS * tip_S.
    Vector3 tip_W(const AxisPositions& commanded, const Vector3& tip_S_mm,
                  SpindleAngle spindle_rad = 0.0) const;
};

}  // namespace trunnion::kinematics

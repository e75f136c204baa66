// Sends moves through the door: limits, durations, positions kept. All motion ends here.
#pragma once

#include "controller/control_state.h"

namespace trunnion {

/// A straight move (G0, G1, G31) of the tip to a program position.
MoveResult move_line(ControlState& c, MotionKind kind, const ControlPosition& target);
/// The same without five-axis functions: the coordinate stages alone.
MoveResult move_straight(ControlState& c, MotionKind kind, const ControlPosition& target);
/// A straight move of the axes to a machine position (G53, G28); the program position follows.
void move_machine(ControlState& c, MotionKind kind, const ControlPosition& target);
/// An arc or helix of the tip; centre and normal in program coordinates.
struct ProgramArc {
    Vector3 centre = Vector3::Zero();
    Vector3 normal = Vector3::UnitZ();
    double sweep_rad = 0.0;  ///< signed about the normal
};
void move_arc(ControlState& c, MotionKind kind, const ControlPosition& target,
              const ProgramArc& arc);
/// A move along a curve of the axes (G43.4, G7.1, G12.1) that ends at `machine_target`.
MoveResult move_curve(ControlState& c, MotionKind kind, const ControlPosition& target,
                      const ControlPosition& machine_target, const PathCurve& curve,
                      double length_mm);
/// How the axes get to a place that has been worked out: along a curve, an arc, or straight.
struct CurveMove {
    const PathCurve* curve = nullptr;
    std::optional<ArcPath> arc;
    double length_mm = 0.0;       ///< of the programmed point's path
    double feed_length_mm = 0.0;  ///< what F divides
};
MoveResult move_along(ControlState& c, MotionKind kind, const ControlPosition& target,
                      const ControlPosition& machine_target, const AxisPositions& to,
                      const CurveMove& way);
void dwell(ControlState& c, double duration_s);

/// Throws OT0500/OT0501 when `to` (mm, rad) leaves the stored stroke.
void check_stroke(const ControlState& c, const AxisPositions& to);

}  // namespace trunnion

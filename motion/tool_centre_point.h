// G43.4 and G43.5: the path of the tip relative to the workpiece determines the axis motion.
#pragma once

#include <vector>

#include "motion/motion.h"
#include "positioning/rotary_transform.h"
#include "positioning/tcp_frame.h"

namespace trunnion::motion {

/// The active believed tool centre point control. "Programmed tip": the tip in M that the
/// coordinate stages of the control give without it.
struct ToolCentrePoint {
    const positioning::RotaryTransform* transform = nullptr;
    Pose pose_WM0;              ///< programmed tip -> W, table-fixed frame
    bool follows_work = false;  ///< WKP: instead the programmed tip is in M at the end of the block
    Vector3 tool_vector_mm = Vector3::Zero();

    /// `present`: axis positions when G43.4 starts.
    static ToolCentrePoint start(const positioning::RotaryTransform& transform,
                                 const AxisPositions& present, positioning::TcpFrame frame,
                                 const Vector3& tool_vector_mm);

    Vector3 tip_W(const Vector3& programmed_M_mm, const AxisPositions& rotaries) const;
    /// Inverse: the programmed tip (mm, M) that corresponds to the axis positions.
    Vector3 programmed_tip_M(const AxisPositions& machine) const;
    /// A direction of the programmed frame (in M) seen from W.
    Vector3 direction_W(const Vector3& programmed_M) const {
        return pose_WM0.rotation * programmed_M;
    }
    AxisPositions machine(const Vector3& tip_W_mm, const AxisPositions& rotaries) const {
        return transform->machine_for_tip(tip_W_mm, rotaries, tool_vector_mm);
    }
};

/// The tip moves straight in W from one axis position to another; all other axes are linear in s.
class TipLine : public PathCurve {
  public:
    /// `start_W`, `end_W`: tip at the two positions, mm.
    TipLine(const ToolCentrePoint& tcp, const AxisPositions& from, const AxisPositions& to,
            const Vector3& start_W, const Vector3& end_W)
        : tcp_(tcp), from_(from), to_(to), start_W_(start_W), end_W_(end_W) {}
    AxisPositions at(double s) const override;

  private:
    const ToolCentrePoint& tcp_;  // referenced: must outlive the move
    const AxisPositions& from_;
    const AxisPositions& to_;
    Vector3 start_W_, end_W_;
};

/// Start, end and arc of a tip path in W, mm.
struct TipWay {
    Vector3 start_W, end_W;
    ArcPath arc_W;
};

/// The tip moves on an arc in W, rotary axes linear in s.
class TipArc : public PathCurve {
  public:
    TipArc(const ToolCentrePoint& tcp, const AxisPositions& from, const AxisPositions& to,
           const TipWay& way)
        : tcp_(tcp), from_(from), to_(to), way_(way) {}
    AxisPositions at(double s) const override;

  private:
    const ToolCentrePoint& tcp_;
    const AxisPositions& from_;
    const AxisPositions& to_;
    TipWay way_;
};

/// G43.5 Q: the tool axis is inclined by `lean_rad` from n_W towards the direction of travel
/// (assumed). Unchanged without travel perpendicular to n_W.
Vector3 leaned(const Vector3& n_W, const Vector3& travel_W, double lean_rad);

/// Values of s, including 0 and 1, such that between them the linear axis motion stays within
/// `tolerance_mm` of the curve (X Y Z; rotary axes are linear, so this is also the error of the
/// tip).
std::vector<double> chord_steps(const PathCurve& curve, double tolerance_mm);

/// Number of intervals for sampling a curve: one for each 5 deg of the axis that turns most.
int curve_parts(const AxisPositions& from, const AxisPositions& to);

}  // namespace trunnion::motion

// G43.4 and G43.5: the tip follows the work, the axes follow the tip.
#pragma once

#include <vector>

#include "motion/motion.h"
#include "positioning/rotary_transform.h"
#include "positioning/tcp_frame.h"

namespace trunnion::motion {

/// The believed tool centre point control in force. "Programmed tip": where the control's
/// coordinate stages put the tip in M without it.
struct ToolCentrePoint {
    const positioning::RotaryTransform* transform = nullptr;
    Pose pose_WM0;              ///< programmed tip -> W, table-fixed frame
    bool follows_work = false;  ///< WKP: the programmed tip is in M at the end of the block instead
    Vector3 tool_vector_mm = Vector3::Zero();

    /// `present`: the axes when G43.4 comes.
    static ToolCentrePoint start(const positioning::RotaryTransform& transform,
                                 const AxisPositions& present, positioning::TcpFrame frame,
                                 const Vector3& tool_vector_mm);

    Vector3 tip_W(const Vector3& programmed_M_mm, const AxisPositions& rotaries) const;
    /// Inverse: the programmed tip that says where the axes stand.
    Vector3 programmed_tip_M(const AxisPositions& machine) const;
    /// A direction in M (of the programmed frame) seen from W.
    Vector3 direction_W(const Vector3& programmed_M) const {
        return pose_WM0.rotation * programmed_M;
    }
    AxisPositions machine(const Vector3& tip_W_mm, const AxisPositions& rotaries) const {
        return transform->machine_for_tip(tip_W_mm, rotaries, tool_vector_mm);
    }
};

/// The tip runs straight in W from one axis position to another, all other axes linear in s.
class TipLine : public PathCurve {
  public:
    /// `start_W`, `end_W`: the tip there, mm.
    TipLine(const ToolCentrePoint& tcp, const AxisPositions& from, const AxisPositions& to,
            const Vector3& start_W, const Vector3& end_W)
        : tcp_(tcp), from_(from), to_(to), start_W_(start_W), end_W_(end_W) {}
    AxisPositions at(double s) const override;

  private:
    const ToolCentrePoint& tcp_;  // these outlive the move that the path belongs to
    const AxisPositions& from_;
    const AxisPositions& to_;
    Vector3 start_W_, end_W_;
};

/// The tip runs on an arc in W, rotaries linear in s; `arc` is in W.
class TipArc : public PathCurve {
  public:
    TipArc(const ToolCentrePoint& tcp, const AxisPositions& from, const AxisPositions& to,
           const Vector3& start_W, const Vector3& end_W, const ArcPath& arc)
        : tcp_(tcp), from_(from), to_(to), start_W_(start_W), end_W_(end_W), arc_(arc) {}
    AxisPositions at(double s) const override;

  private:
    const ToolCentrePoint& tcp_;
    const AxisPositions& from_;
    const AxisPositions& to_;
    Vector3 start_W_, end_W_;
    ArcPath arc_;
};

/// G43.5 Q: the tool axis leans by `lean_rad` from n towards the direction of travel (assumed);
/// unchanged without travel across n.
Vector3 leaned(const Vector3& n_W, const Vector3& travel_W, double lean_rad);

/// Values of s, 0 and 1 included, between which the straight line of the axes stays within
/// `tolerance_mm` of the curve (X Y Z; since rotaries run linearly that is the error of the tip
/// too).
std::vector<double> chord_steps(const PathCurve& curve, double tolerance_mm);

/// Into how many parts a curve is cut to look at it: one for each 5 deg of the axis that turns
/// most.
int curve_parts(const AxisPositions& from, const AxisPositions& to);

}  // namespace trunnion::motion

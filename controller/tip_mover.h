// Moves under G43.4, G43.5 and M128: the tip follows its path on the workpiece, the axes follow the
// tip.
#pragma once

#include "controller/axis_mover.h"
#include "controller/tool_vector.h"

namespace trunnion::controller {

/// The stage in front of the axes while tool centre point control is active (`frames.tip`). M128
/// without G43.4 corrects the tip at block ends only; between them the axes move linearly.
class TipMover {
  public:
    TipMover(const SortedWords& words, const Modal& modal, const Frames& frames, AxisMover& axes)
        : words_(words), modal_(modal), frames_(frames), axes_(axes) {}

    /// A straight move of the tip, relative to the workpiece, to a program position. PS5421 when
    /// the words command the tool axis in the wrong way (angles or vector), and for a tool
    /// direction that no rotary position reaches.
    motion::MoveResult line(motion::MotionKind kind, const offsets::ControlPosition& target);
    /// An arc of the tip relative to the workpiece; PS5421 under G43.5.
    void arc(motion::MotionKind kind, const offsets::ControlPosition& target,
             const ProgramArc& arc);

  private:
    struct TipWay {
        Vector3 start_W, end_W;  ///< of the tip, mm
        MoveTarget target;
    };
    const motion::ToolCentrePoint& tcp() const { return *frames_.tip.in_force; }
    void check_words() const;
    Vector3 staged_tip(const offsets::ControlPosition& machine) const;
    Vector3 start_of_way() const;
    TipWay way_to(const offsets::ControlPosition& target) const;
    void orient_tool(const Vector3& travel_W, AxisPositions& rotaries) const;
    double feed_length(double tip_mm, const offsets::ControlPosition& machine) const;
    offsets::ControlPosition reached(offsets::ControlPosition target,
                                     const offsets::ControlPosition& machine) const;
    bool turns(const AxisPositions& to) const;
    bool keeps_tip_on_way() const;
    motion::ArcPath arc_in_W(const ProgramArc& arc, const AxisPositions& rotaries) const;

    const SortedWords& words_;
    const Modal& modal_;
    const Frames& frames_;
    AxisMover& axes_;
};

}  // namespace trunnion::controller

// Moves under G43.4, G43.5 and M128: the tip is led along its way on the work, the axes follow.
#pragma once

#include "controller/axis_mover.h"
#include "controller/tool_vector.h"

namespace trunnion::controller {

/// The stage in front of the axes while tool centre point control is in force (`frames.tip`). M128
/// without G43.4 puts the tip right at the ends of blocks alone: the axes run straight between.
class TipMover {
  public:
    TipMover(const SortedWords& words, const Modal& modal, const Frames& frames, AxisMover& axes)
        : words_(words), modal_(modal), frames_(frames), axes_(axes) {}

    /// A straight move of the tip on the work to a program position. PS5421 for words of the other
    /// way to command the tool axis, and for an axis that no rotary position reaches.
    motion::MoveResult line(motion::MotionKind kind, const offsets::ControlPosition& target);
    /// An arc of the tip on the work; PS5421 under G43.5.
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

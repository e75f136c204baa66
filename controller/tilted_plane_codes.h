// G68.2, G68.3, G68.4, G69, G53.1 and G53.6: tilted working plane and tool axis direction.
#pragma once

#include "controller/mover.h"
#include "positioning/tilted_plane.h"

namespace trunnion::controller {

/// PS5421 under tool centre point control, PS5457 under G54.2 or cutter compensation.
void check_plane_may_start(const Modal& modal, const Frames& frames);
/// A new frame; G52 counts along the plane from now on.
void set_plane(const TiltedPlaneState& plane, Modal& modal, Frames& frames, Mover& mover);

/// A definition that takes several blocks (P2, P3). PS5421 under G43.4, PS5456 when planes are
/// nested too deep, PS5457 for a wrong definition or state.
class PlaneCodes {
  public:
    /// G68.2, and G68.4 on top of it.
    void define(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover, int code10);
    bool pending() const { return definition_.pending(); }
    /// Between the blocks of P2 and P3 no other block may come: PS5457.
    void check_goes_on(const SortedWords& words) const;

  private:
    positioning::PlaneDefinition definition_;
    int code10_ = 0;
};

/// G68.3
void define_plane_by_tool(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover);
/// G69 of a tilted plane: G52 of before counts again. On a Hurco the plane below is in force.
void cancel_tilted_plane(Modal& modal, Frames& frames, Mover& mover);
/// G53.1, and G53.6 which keeps the tip of tool H (that in force without H), R mm further from it.
/// Both solutions stand in the notes. PS5458 when there is no plane or no position within travel.
void turn_tool_axis(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover);
void turn_tool_axis_keeping_tip(const SortedWords& words, Modal& modal, Frames& frames,
                                Mover& mover);

}  // namespace trunnion::controller

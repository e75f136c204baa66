// G68.2, G68.3, G68.4, G69, G53.1 and G53.6: tilted working plane and tool axis direction.
#pragma once

#include "controller/mover.h"
#include "positioning/tilted_plane.h"

namespace trunnion::controller {

/// PS5421 under tool centre point control, PS5457 under G54.2 or cutter compensation.
void check_plane_may_start(const Modal& modal, const Frames& frames);
/// Activates a new plane; from now on G52 acts along its axes.
void set_plane(const TiltedPlaneState& plane, Modal& modal, Frames& frames, Mover& mover);

/// A definition of several blocks (P2, P3). PS5421 under G43.4, PS5456 when planes are nested too
/// deeply, PS5457 for an invalid definition or state.
class PlaneCodes {
  public:
    /// G68.2, and G68.4 on top of it.
    void define(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover, int code10);
    bool pending() const { return definition_.pending(); }
    /// No other block is allowed between the blocks of P2 and P3: PS5457.
    void check_goes_on(const SortedWords& words) const;

  private:
    positioning::PlaneDefinition definition_;
    int code10_ = 0;
};

/// G68.3
void define_plane_by_tool(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover);
/// G69 of a tilted plane: the previous G52 is active again. On a Hurco the plane below becomes
/// active.
void cancel_tilted_plane(Modal& modal, Frames& frames, Mover& mover);
/// G53.1; G53.6 keeps the tip position of tool H (without H the active one) at an additional
/// distance of R mm. Both solutions are listed in the notes. PS5458 when there is no plane or no
/// solution within travel.
void turn_tool_axis(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover);
void turn_tool_axis_keeping_tip(const SortedWords& words, Modal& modal, Frames& frames,
                                Mover& mover);

}  // namespace trunnion::controller

// G2.4 and G3.4 of a Hurco: an arc in space through a point on the way to an end point.
#pragma once

#include "controller/mover.h"

namespace trunnion::controller {

/// The block with the code (and, while it stays in force, every other block) has the point on the
/// way, the next block the end. Without rotary words. Throws alarm 9004.
class Arc3d {
  public:
    void move(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover);
    /// Behind the point on the way nothing but the end point may come.
    void check_goes_on(const SortedWords& words) const;

  private:
    std::optional<offsets::ControlPosition> on_the_way_;
};

/// The arc from `start` through `middle` to `end`, mm; nothing when they lie in a line.
std::optional<ProgramArc> arc_through(const Vector3& start, const Vector3& middle,
                                      const Vector3& end);

}  // namespace trunnion::controller

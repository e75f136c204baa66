// G2.4 and G3.4 of a Hurco: an arc in space through an intermediate point.
#pragma once

#include "controller/mover.h"

namespace trunnion::controller {

/// The block with the code (and, while the code is active, every other block) gives the
/// intermediate point, the next block the end point. No rotary words. Throws alarm 9004.
class Arc3d {
  public:
    void move(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover);
    /// After the intermediate point only the end point is allowed.
    void check_goes_on(const SortedWords& words) const;

  private:
    std::optional<offsets::ControlPosition> on_the_way_;
};

/// The arc from `start` through `middle` to `end`, mm; empty for collinear points.
std::optional<ProgramArc> arc_through(const Vector3& start, const Vector3& middle,
                                      const Vector3& end);

}  // namespace trunnion::controller

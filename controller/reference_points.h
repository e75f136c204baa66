// G27 to G30: reference positions (1240-1243) by way of an intermediate point, as rapids.
#pragma once

#include "controller/mover.h"

namespace trunnion::controller {

/// All alarm with PS0044 in a canned cycle.
class ReferencePoints {
  public:
    /// G28, and G30 P2 to P4 (PS0046 for any other).
    void go(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover, int code10);
    /// G29: back by the last intermediate point; under G91 the words count from there.
    void come_back(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover);

  private:
    offsets::ControlPosition intermediate_;  ///< program coordinates
};

/// G27: a rapid that must end at the reference position, PS0092.
void check_reference(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover);

}  // namespace trunnion::controller

// G27 to G30: rapids to reference positions (1240-1243) via an intermediate point.
#pragma once

#include "controller/mover.h"

namespace trunnion::controller {

/// All raise PS0044 in a canned cycle.
class ReferencePoints {
  public:
    /// G28, and G30 P2 to P4 (PS0046 for any other P).
    void go(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover, int code10);
    /// G29: back via the last intermediate point; under G91 the words start there.
    void come_back(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover);

  private:
    offsets::ControlPosition intermediate_;  ///< program coordinates
};

/// G27: a rapid that must end at the reference position, else PS0092.
void check_reference(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover);

}  // namespace trunnion::controller

// Where the stylus ball meets the bodies of a setup on a move.
#pragma once

#include <optional>
#include <vector>

#include "emulator/observer.h"
#include "motion/motion.h"
#include "probe/solids.h"

namespace trunnion::emulator {

/// The solids of a body, in its own frame.
std::vector<probe::Solid> solids_of(const setup::Body& body);

/// A contact with a body.
struct BodyTouch {
    double s = 1.0;          ///< of the move, where the skip latches
    double contact_s = 1.0;  ///< where ball and body meet
    std::string body;
};

/// The first body that the ball meets on the move that starts at `start`, the sample of its
/// beginning. Errors, effects on bodies of the machine and the probe's pretravel are in; noise is
/// not.
std::optional<BodyTouch> touch_bodies(const motion::AxisMove& move, const AxisSample& start,
                                      const Observer& observer);

}  // namespace trunnion::emulator

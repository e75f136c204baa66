// Passes a move of the control through the history of travel.
#pragma once

#include "motion/motion.h"
#include "records/travel.h"

namespace trunnion::emulator {

/// Advances the history along a move to its end, including reversals on an arc or a curve.
void follow(records::TravelHistory& history, const motion::AxisMove& move);

}  // namespace trunnion::emulator

// A move of the control through the history of travel.
#pragma once

#include "motion/motion.h"
#include "records/travel.h"

namespace trunnion::emulator {

/// Along a move to its end: axes that turn round on an arc or curve are seen to.
void follow(records::TravelHistory& history, const motion::AxisMove& move);

}  // namespace trunnion::emulator

// A move of the control through the history of travel.
#pragma once

#include "motion/motion.h"
#include "records/travel.h"

namespace trunnion {

/// Along a move to its end: axes that turn round on an arc or curve are seen to.
void follow(TravelHistory& history, const AxisMove& move);

}  // namespace trunnion

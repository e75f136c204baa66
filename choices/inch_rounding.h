// What is left of a gap where a control counts the inches of a program in its increment.
#pragma once

#include "choices/judged_log.h"

namespace trunnion::choices {

/// The program has inches, nobody states the noise, no cause is claimed, and each axis is off by no
/// more than 0.0001 inch everywhere: that is the increment of the other control, and no gap. A note
/// tells.
void settle_inch_rounding(const Asked& asked, const LogOfProgram& log, Answer& answer);

}  // namespace trunnion::choices

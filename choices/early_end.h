// A log that ends within the program: did the other control stop there?
#pragma once

#include "choices/judged_log.h"

namespace trunnion::choices {

/// Tells the block from which on the log has no moves. If the log shows that the control stood
/// there (rows at rest at the end, a last sample exactly on an end, or a trace of all its moves),
/// that is a gap: an option with which this control stops there, or unknown. A log cut off in
/// motion is none.
void tell_early_end(const Asked& asked, const LogOfProgram& log, Answer& answer);

}  // namespace trunnion::choices

// A log judged whose noise is not known before: few rows a block, or ends of moves.
#pragma once

#include "choices/judged_log.h"

namespace trunnion::choices {

/// With the noise that the log states or shows by its density; else with that which its rows have
/// beside the control as it is set, and if causes explain it only so, with none but that of its
/// digits, or that beside the causes.
Answer judged(const Asked& asked, LogOfProgram log);

}  // namespace trunnion::choices

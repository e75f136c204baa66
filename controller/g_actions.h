// Execution of G codes: the table from actions to subjects.
#pragma once

#include "controller/control.h"

namespace trunnion::controller {

/// Executes one code of the block, or sets its modal group.
void carry_out(Control& c, const GCode& code);

}  // namespace trunnion::controller

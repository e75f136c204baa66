// The tool length in force, for whoever puts it along another direction (G43.4, G53.1).
#pragma once

#include "controller/control_state.h"

namespace trunnion {

/// Geometry + wear of offset number H in mm; 0 for H0. Throws PS0030.
double tool_length_mm(const ControlState& c, int number);
/// Puts a length vector (tip to gauge point) in force. The program position stays and the axis will
/// move by the change with this block (5006#6 = 0), or the position shifts without motion.
void apply_tool_length(ControlState& c, const ControlPosition& length);
/// H without a code of its own in the block.
void change_length_number(ControlState& c);

}  // namespace trunnion

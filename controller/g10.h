// Data blocks between G10 L3, L50 or L52 and G11.
#pragma once

#include "controller/control_state.h"
#include "interpreter/block_words.h"

namespace trunnion {

/// One data block: N is the parameter number, P the axis, R the value (a byte for bit parameters).
/// Throws PS0231 when N or R is missing.
void enter_data(ControlState& c, const BlockWords& block);

}  // namespace trunnion

// Variables that are the offset stores: #2001.. tools, #5201.. work offsets, #5521.. fixture
// offsets.
#pragma once

#include "controller/control_state.h"

namespace trunnion {

/// False when the number belongs to no store. Lengths in the unit in force (G20: inch).
bool read_offset_variable(const ControlState& c, int number, double& value);
bool write_offset_variable(ControlState& c, int number, double value);

}  // namespace trunnion

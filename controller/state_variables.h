// Variables that are the control's state: alarms, clock, modal codes, positions, signals.
#pragma once

#include <string_view>

#include "controller/control_state.h"

namespace trunnion {

/// False when the number is none of these.
bool read_state_variable(const ControlState& c, int number, double& value);
/// False when the number cannot be written. #3000 throws the program's alarm with `comment`.
bool write_state_variable(ControlState& c, int number, double value, std::string_view comment);

}  // namespace trunnion

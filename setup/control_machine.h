// The machine that a control's own stores describe, where nobody wrote a setup file.
#pragma once

#include <string>

#include "setup/setup.h"

namespace trunnion::setup {

/// Rotary axes by 19680-19714, X Y Z as slides of the tool, strokes and rapid speeds by 1320, 1321
/// and 1420, no errors, no devices. `path` is for
/// messages. Throws InputError when 19680 names no two real rotary axes, Alarm 5459 for numbers
/// that cannot be.
Setup setup_of_control(const offsets::Stores& stores, const std::string& path);

}  // namespace trunnion::setup

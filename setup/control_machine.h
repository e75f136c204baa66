// The machine described by the stores of a control, for use without a setup file.
#pragma once

#include <string>

#include "setup/setup.h"

namespace trunnion::setup {

/// 19680-19690 name two real rotary axes.
bool has_rotary_geometry(const offsets::Stores& stores);

/// The axes of 1020: X Y Z as slides of the tool, U V W beside them by 1022, rotary axes by
/// 19680-19714; those that no parameter places are auxiliary. Strokes and rapid speeds by 1320,
/// 1321 and 1420. The machine has the backlash and pitch errors that 1851 and the pitch data take
/// away (assumed: what a builder compensates fits), no other errors, no devices. `path` is for
/// messages. Throws InputError for a hypothetical axis, Alarm 5459 for numbers that cannot be.
Setup setup_of_control(const offsets::Stores& stores, const std::string& path);

}  // namespace trunnion::setup

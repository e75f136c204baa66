// G codes of a Hurco: its own, those shared with Fanuc, and those that it does not have.
#pragma once

#include "controller/g_codes.h"
#include "controller/settings.h"

namespace trunnion::controller {

/// The code of a word's value on a Hurco with this NC dialect, or nullptr when the dialect does not
/// know it or it is not emulated.
const GCode* find_hurco_g_code(double value, bool bnc);
/// The code on a control with these settings: its own, the option G33, or a code of the builder; or
/// nullptr.
const GCode* find_g_code(double value, const ControlSettings& settings);

}  // namespace trunnion::controller

// G codes of a Hurco: its own, those it shares with a Fanuc, those it does not have.
#pragma once

#include "controller/g_codes.h"
#include "controller/settings.h"

namespace trunnion::controller {

/// The code of a word's value on a Hurco with this NC dialect, or nullptr when it is not known
/// there or not emulated.
const GCode* find_hurco_g_code(double value, bool bnc);
/// The code on the control of these settings: its own, the option G33, or one of the builder.
const GCode* find_g_code(double value, const ControlSettings& settings);

}  // namespace trunnion::controller

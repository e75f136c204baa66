// Backlash and pitch error compensation of the control, on the machine that it drives.
#pragma once

#include "emulator/effect_model.h"
#include "setup/setup.h"

namespace trunnion::emulator {

/// Backlash and pitch compensation that the setup's control adds to the axis positions. Programs,
/// skip positions and readings do not contain it. It adds to the errors of the machine, so a drive
/// that lags by the value of 1851 shows no reversal error. Null when nothing is compensated.
std::shared_ptr<const EffectModel> control_compensation(const setup::Setup& setup);

}  // namespace trunnion::emulator

// Backlash and pitch error compensation of the control, on the machine that it drives.
#pragma once

#include "emulator/effect_model.h"
#include "setup/setup.h"

namespace trunnion::emulator {

/// What the parameters of the setup's control add to the positions of the axes behind its back:
/// programs, skip positions and readings count without it. It acts beside the machine's own errors,
/// so a drive that lags by what 1851 says reads no reversal. Null where nothing is compensated.
std::shared_ptr<const EffectModel> control_compensation(const setup::Setup& setup);

}  // namespace trunnion::emulator

// Refuses what only wrong units, a wrong frame or the setup of another machine explain.
#pragma once

#include "emulator/replay.h"
#include "identification/base_model.h"

namespace trunnion::identification {

/// Residual beyond which units, frame or setup are wrong, mm: 5, of an arm 50.
double absurd_residual_mm(const setup::Setup& setup);

/// Implausible residuals of a fitted model are refused (InputError), or noted when the user
/// declared them as intended: by `allow_large` of the setup's model or by a `sigma_mm` of the row.
void tell_absurd_residuals(BaseModel& model, const emulator::Replay& replay,
                           const records::ReadingTable& table);
/// The same for a location error, and for the zero of an encoder.
void tell_absurd_value(BaseModel& model, const FitParameter& p, const records::ReadingTable& table);

}  // namespace trunnion::identification

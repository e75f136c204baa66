// Keys of several effects together: a bounded search, and what their uncertainty adds.
#pragma once

#include <vector>

#include "identification/key_gain.h"

namespace trunnion::identification {

/// Weighted squares of what the base leaves that the effects explain together, fitted beside it.
double explained(const emulator::Replay& replay, const BaseModel& base,
                 const std::vector<KeyedEffect>& effects);

/// Moves all free keys at once so that the effects explain most of what the base leaves (NLopt,
/// bounded by half the first and twice the last grid value).
void refine_together(const emulator::Replay& replay, const BaseModel& base,
                     std::vector<KeyedEffect>& effects);

/// Sigma of the free keys (NaN when the readings do not see one), and of all other parameters when
/// the keys are not known exactly. `base` is the fit with all effects in it, `effects` have the
/// fitted values.
void add_key_uncertainty(const emulator::Replay& replay, const std::vector<KeyedEffect>& effects,
                         const BaseModel& base, std::vector<FitParameter>& parameters);

}  // namespace trunnion::identification

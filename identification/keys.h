// Simultaneous search of the keys of several effects, and their contribution to the uncertainty.
#pragma once

#include <vector>

#include "identification/key_gain.h"

namespace trunnion::identification {

/// Weighted sum of squares of the base residuals that the effects explain together, fitted beside
/// the base.
double explained(const emulator::Replay& replay, const BaseModel& base,
                 const std::vector<KeyedEffect>& effects);

/// Optimises all free keys simultaneously so that the effects explain the most of the base
/// residuals (NLopt, bounds: half the first and twice the last grid value).
void refine_together(const emulator::Replay& replay, const BaseModel& base,
                     std::vector<KeyedEffect>& effects);

/// Adds the sigma of the free keys (NaN for an unobservable key), and the contribution of their
/// uncertainty to all other parameters. `base` is the fit with all effects included, `effects` have
/// the fitted values.
void add_key_uncertainty(const emulator::Replay& replay, const std::vector<KeyedEffect>& effects,
                         const BaseModel& base, std::vector<FitParameter>& parameters);

}  // namespace trunnion::identification

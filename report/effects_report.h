// The catalogue of effects as the terminal shows it, and as JSON.
#pragma once

#include <string>
#include <vector>

#include "effects/effect.h"

namespace trunnion::report {

/// trunnion.effects/1 (docs/effects.md), one line break at its end.
std::string effects_json(const std::vector<effects::Effect>& list);
/// One effect with its formula, its parameters and an example to type.
std::string effect_text(const effects::Effect& effect);
/// A line or two for each effect.
std::string effects_text(const std::vector<effects::Effect>& list);

}  // namespace trunnion::report

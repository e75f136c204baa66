// The catalogue of effects as text for the terminal, and as JSON.
#pragma once

#include <string>
#include <vector>

#include "base/read_file.h"
#include "effects/effect.h"

namespace trunnion::report {

/// trunnion.effects/1 (docs/effects.md), one line break at its end.
std::string effects_json(const std::vector<effects::Effect>& list,
                         const std::vector<FileRead>& inputs = {});
/// One effect with its formula, its parameters and an example to type.
std::string effect_text(const effects::Effect& effect);
/// One or two lines for each effect.
std::string effects_text(const std::vector<effects::Effect>& list);

}  // namespace trunnion::report

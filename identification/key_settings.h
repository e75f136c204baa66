// All combinations of the values on the grids of keys.
#pragma once

#include <vector>

#include "effects/effect.h"

namespace trunnion::identification {

using TakesKey = bool (*)(const effects::EffectParameter&);
inline bool is_any_key(const effects::EffectParameter& p) {
    return p.is_key();
}

/// Values of an effect with every combination of the grids of its keys that `varies` takes, the
/// first key varying fastest; the others as in `values`, in the order and units of the parameters.
std::vector<std::vector<double>> key_settings(const effects::Effect& effect,
                                              const std::vector<double>& values,
                                              TakesKey varies = is_any_key);

}  // namespace trunnion::identification

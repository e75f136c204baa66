// A machine with effects drawn from its catalogue: which, how large and which keys, by a seed
// alone.
#pragma once

#include "base/random.h"
#include "effects/settings.h"
#include "records/readings.h"

namespace trunnion {

/// Adds `count` effects of 1 to 4 times their usual size, either sign, keys of their grids.
inline setup::Setup with_drawn_effects(setup::Setup setup, const records::ReadingTable& table,
                                       int count, std::uint64_t seed) {
    SeededNoise random(seed);
    const effects::Catalogue catalogue =
        effects::make_catalogue(setup, effects::extent_of(setup, table));
    for (int k = 0; k < count; ++k) {
        const effects::Effect& effect = catalogue[random.bits() % catalogue.size()];
        std::vector<double> values = effect.zeros();
        for (std::size_t i = 0; i < values.size(); ++i) {
            const effects::EffectParameter& parameter = effect.parameters[i];
            const double size = 1.0 + 3.0 * random.uniform();
            if (parameter.is_key())
                values[i] = parameter.grid[random.bits() % parameter.grid.size()];
            else
                values[i] = (random.uniform() < 0.5 ? -size : size) * parameter.typical;
        }
        setup.effects.push_back(effects::setting_of(effect, values));
    }
    return setup;
}

}  // namespace trunnion

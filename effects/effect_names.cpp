#include "effects/effect_names.h"

namespace trunnion::effects {

std::vector<std::string> names_of(const Catalogue& catalogue) {
    std::vector<std::string> names;
    for (const Effect& effect : catalogue) names.push_back(effect.name);
    return names;
}

}  // namespace trunnion::effects

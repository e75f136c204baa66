#include "identification/key_settings.h"

#include <utility>

namespace trunnion::identification {

std::vector<std::vector<double>> key_settings(const effects::Effect& effect,
                                              const std::vector<double>& values, TakesKey varies) {
    std::vector<std::vector<double>> list{values};
    for (std::size_t j = effect.parameters.size(); j-- > 0;) {
        if (!varies(effect.parameters[j])) continue;
        std::vector<std::vector<double>> longer;
        for (const std::vector<double>& setting : list)
            for (const double value : effect.parameters[j].grid) {
                longer.push_back(setting);
                longer.back()[j] = value;
            }
        list = std::move(longer);
    }
    return list;
}

}  // namespace trunnion::identification

#include "identification/index_errors.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/rounded.h"

namespace trunnion::identification {

std::string index_effect(const setup::Setup& setup) {
    const kinematics::Chain& chain = setup.machine.chain;
    if (!setup::is_arm(chain) || !chain.work.empty() || chain.tool.size() != 2 ||
        !chain.tool.front().rotary)
        return {};
    return chain.tool.front().name + ".zero";
}

setup::Setup with_index_errors(setup::Setup setup, const records::ReadingTable& table) {
    const std::string name = index_effect(setup);
    std::vector<std::string>& list = setup.model.modelled;
    const bool angles = std::any_of(
        table.rows.begin(), table.rows.end(),
        [](const records::Reading& row) { return row.device == records::Device::angle; });
    if (!name.empty() && angles && std::find(list.begin(), list.end(), name) == list.end())
        list.push_back(name);
    return setup;
}

std::vector<std::string> index_words(const setup::Setup& fitted) {
    const std::string name = index_effect(fitted);
    std::vector<std::string> sentences;
    for (const setup::EffectSetting& effect : fitted.effects) {
        const auto value = effect.parameters.find("offset_rad");
        if (name.empty() || effect.name != name || value == effect.parameters.end() ||
            value->second.front() == 0.0)
            continue;
        sentences.push_back(fmt::format("the index of {} is {} µrad off ({})",
                                        fitted.machine.chain.tool.front().name,
                                        three_digits(1e6 * value->second.front()), name));
    }
    return sentences;
}

}  // namespace trunnion::identification

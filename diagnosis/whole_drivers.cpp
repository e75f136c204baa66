#include "diagnosis/whole_drivers.h"

#include <utility>

namespace trunnion::diagnosis {
namespace {

std::optional<std::size_t> whole_of(const Design& design, std::size_t driver) {
    const ColumnGroup& held = design.group(driver);
    if (held.kind != GroupKind::driver || held.is_whole) return std::nullopt;
    for (std::size_t k = 0; k < design.groups().size(); ++k)
        if (design.group(k).is_whole && same_cause(design.group(k), held)) return k;
    return std::nullopt;
}

}  // namespace

void add_whole(Design& design, ColumnGroup driver) {
    driver.is_whole = true;
    design.hide(design.add(std::move(driver)));
}

Model with_whole_drivers(Design& design, const SearchSetting& setting, Model model) {
    for (std::size_t k = 0; k < model.members.size() && !setting.stopped(); ++k) {
        const std::optional<std::size_t> whole = whole_of(design, model.members[k]);
        if (!whole) continue;
        Model trial = model;
        trial.members[k] = *whole;
        trial = pruned(design, setting, tuned(design, setting, std::move(trial), 3));
        if (evidence(design, trial) < evidence(design, model) + better) continue;
        model = settled(design, setting, std::move(trial));
        k = 0;
    }
    return model;
}

}  // namespace trunnion::diagnosis

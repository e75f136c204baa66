#include "diagnosis/search/whole_play.h"

#include <algorithm>
#include <optional>

namespace trunnion::diagnosis {
namespace {

constexpr double usual_play = 1.0;  ///< typical sizes, from which the variances are tuned

/// The play of the same axis that is the same everywhere.
std::optional<std::size_t> even_play(const Design& design, const ColumnGroup& table) {
    for (std::size_t k = 0; k < design.groups().size(); ++k)
        if (const ColumnGroup& group = design.group(k);
            group.kind == GroupKind::textbook && group.name == table.name && !group.is_change() &&
            design.groups()[k].visible())
            return k;
    return {};
}

bool holds(const Design& design, const Model& model, const ColumnGroup& group) {
    return std::any_of(model.members.begin(), model.members.end(), [&](std::size_t m) {
        return design.group(m).kind == group.kind && design.group(m).name == group.name;
    });
}

void add_to(Model& model, std::size_t group) {
    model.members.push_back(group);
    model.variances.tau.push_back(usual_play);
}

}  // namespace

Model with_whole_play(Design& design, const SearchSetting& setting, const Model& model,
                      const Model& seen) {
    Model best = model;
    for (std::size_t k = 0; k < design.groups().size() && !setting.stopped(); ++k) {
        const ColumnGroup& table = design.group(k);
        if (table.kind != GroupKind::table || !table.table.play || table.is_line ||
            !design.groups()[k].visible() || holds(design, model, table))
            continue;
        const auto even = even_play(design, table);
        if (!even || holds(design, model, design.group(*even))) continue;
        Model trial = seen;
        add_to(trial, *even);
        add_to(trial, k);
        trial = tuned(design, setting, std::move(trial), 3);
        if (trial.score > best.score + better) best = std::move(trial);
    }
    return best;
}

}  // namespace trunnion::diagnosis

#include "diagnosis/refined_keys.h"

#include <algorithm>
#include <utility>

#include "diagnosis/groups/ripples.h"
#include "diagnosis/round.h"
#include "identification/identify.h"

namespace trunnion::diagnosis {
namespace {

using effects::EffectKind;

/// Columns of the members of known form, mm.
Eigen::MatrixXd columns_of_known_forms(const Prepared& p, const Design& design,
                                       const Model& model) {
    Eigen::MatrixXd all(p.base.residual_mm.size(), 0);
    for (const std::size_t m : model.members) {
        const ColumnGroup& group = design.group(m);
        if (!group.effect || group.is_change()) continue;
        const Eigen::MatrixXd own = columns_on(p.replay, p.base.gradient, group);
        all.conservativeResize(Eigen::NoChange, all.cols() + own.cols());
        all.rightCols(own.cols()) = own;
    }
    return all;
}

/// The keys with those of few values (the law of a decay) at the values that explain most.
std::vector<double> best_of_few(const identification::KeyGain& gain, const effects::Effect& effect,
                                std::vector<double> keys) {
    constexpr std::size_t few = 4;
    double best = gain(effect, keys);
    for (std::size_t j = 0; j < keys.size(); ++j) {
        const effects::EffectParameter& p = effect.parameters[j];
        if (!p.is_key() || p.refine || p.grid.size() > few) continue;
        for (const double value : p.grid) {
            std::vector<double> trial = keys;
            trial[j] = value;
            const double gained = gain(effect, trial);
            if (gained <= best) continue;
            best = gained;
            keys = std::move(trial);
        }
    }
    return keys;
}

}  // namespace

identification::KeyGain gain_beside(const KeyedDesign& keyed, const Model& model) {
    const Prepared& p = keyed.prepared;
    return {p.replay, p.base, rest_of(p, keyed.design, model),
            columns_of_known_forms(p, keyed.design, model)};
}

std::optional<std::size_t> refined_group(const KeyedDesign& keyed, const Model& model,
                                         std::size_t position) {
    const auto& [design, p, whitener] = keyed;
    const ColumnGroup group = design.group(model.members[position]);
    const identification::KeyGain gain = gain_beside(keyed, without(model, position));
    return add_ripple_or_other(
        design, p, whitener, *group.effect,
        identification::refine_keys(gain, *group.effect,
                                    best_of_few(gain, *group.effect, group.keys)));
}

namespace {

Model without_drivers(const Design& design, Model model) {
    for (std::size_t k = model.members.size(); k-- > 0;)
        if (design.group(model.members[k]).kind == GroupKind::driver) model = without(model, k);
    return model;
}

bool is_form_along(const ColumnGroup& group) {
    return group.kind == GroupKind::table &&
           (group.table.play || group.table.motion == EffectKind::positioning);
}

/// The model without the free forms along an axis of which a key was searched.
Model without_forms_of_keyed_axes(const Design& design, Model model) {
    std::vector<Axis> keyed;
    for (const std::size_t m : model.members)
        if (const ColumnGroup& group = design.group(m);
            group.kind == GroupKind::periodic && group.effect->axis)
            keyed.push_back(*group.effect->axis);
    for (std::size_t k = model.members.size(); k-- > 0;) {
        const ColumnGroup& group = design.group(model.members[k]);
        if (is_form_along(group) &&
            std::count(keyed.begin(), keyed.end(), group.table.axis.axis) > 0)
            model = without(model, k);
    }
    return model;
}

}  // namespace

Model with_new_keys(const KeyedDesign& keyed, const SearchSetting& setting, Model model) {
    bool changed = false;
    Model trial = model;
    for (std::size_t k = 0; k < trial.members.size(); ++k) {
        if (keyed.design.group(trial.members[k]).kind != GroupKind::periodic) continue;
        const auto better = refined_group(keyed, trial, k);
        if (!better) continue;
        trial.members[k] = *better;
        changed = true;
    }
    return changed ? tuned(keyed.design, setting, std::move(trial), 2) : model;
}

Model with_refined_keys(const KeyedDesign& keyed, const SearchSetting& setting, Model model) {
    const Model plain = without_drivers(keyed.design, model);
    const Model bare = without_forms_of_keyed_axes(keyed.design, plain);
    std::vector<Model> starts{plain};
    if (bare.members.size() < plain.members.size()) starts.push_back(bare);
    for (const Model& start : starts) {
        const Model keyed_anew = with_new_keys(keyed, setting, start);
        if (keyed_anew.members == start.members) continue;
        Model trial = grown(keyed.design, setting, keyed_anew);
        if (trial.score > model.score) model = std::move(trial);
    }
    return model;
}

Model without_forms_along(const Design& design, Model model) {
    model = without_drivers(design, std::move(model));
    for (std::size_t k = model.members.size(); k-- > 0;)
        if (is_form_along(design.group(model.members[k]))) model = without(model, k);
    return model;
}

}  // namespace trunnion::diagnosis

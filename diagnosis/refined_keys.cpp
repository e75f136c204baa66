#include "diagnosis/refined_keys.h"

#include <algorithm>
#include <utility>

#include "diagnosis/groups/ripples.h"
#include "diagnosis/round.h"
#include "identification/identify.h"
#include "identification/key_settings.h"

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

constexpr std::size_t few_values = 4;  ///< of a key that is not refined: the law of a decay

bool has_few_values(const effects::EffectParameter& p) {
    return p.is_key() && !p.refine && p.grid.size() <= few_values;
}

}  // namespace

std::vector<double> best_keys(const identification::KeyGain& gain, const effects::Effect& effect,
                              const std::vector<double>& keys) {
    constexpr double near = 0.95;  // of what the best setting explains (assumed)
    std::vector<double> best = identification::refine_keys(gain, effect, keys);
    const auto laws = identification::key_settings(effect, keys, has_few_values);
    if (laws.size() == 1) return best;
    const auto is_refined = [](const effects::EffectParameter& p) {
        return p.is_key() && p.refine;
    };
    double most = gain(effect, best);
    for (const std::vector<double>& law : laws) {
        std::vector<double> start = law;
        double gained = 0.0;
        for (const std::vector<double>& setting :
             identification::key_settings(effect, law, is_refined))
            if (const double own = gain(effect, setting); own > gained) {
                gained = own;
                start = setting;
            }
        if (gained < near * most) continue;
        start = identification::refine_keys(gain, effect, std::move(start));
        if (gained = gain(effect, start); gained <= most) continue;
        most = gained;
        best = std::move(start);
    }
    return best;
}

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
    return add_ripple_or_other(design, p, whitener, *group.effect,
                               identification::refine_keys(gain, *group.effect, group.keys));
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
        const ColumnGroup group = keyed.design.group(trial.members[k]);
        if (group.kind != GroupKind::periodic) continue;
        const identification::KeyGain gain = gain_beside(keyed, without(trial, k));
        const auto better =
            add_ripple_or_other(keyed.design, keyed.prepared, keyed.whitener, *group.effect,
                                best_keys(gain, *group.effect, group.keys));
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

#include "diagnosis/search/stand_ins.h"

#include <algorithm>

#include "diagnosis/rules/rules.h"

namespace trunnion::diagnosis {
namespace {

constexpr Eigen::Index few = 3;  ///< parameters, at most, of an effect of a pair
constexpr std::size_t pairs_tuned = 3;

struct Candidate {
    std::size_t group = 0;
    Eigen::Index first = 0, count = 0;  ///< its columns among those of all candidates
};

struct Pair {
    std::size_t first = 0, second = 0;  ///< groups
    double tau = 1.0, value = 0.0;      ///< of both; mean gain plus log priors, nats
};

/// Textbook effects of few parameters that neither a member nor `held` is.
std::vector<Candidate> candidates(const Design& design, const Model& rest,
                                  const ColumnGroup& held) {
    std::vector<Candidate> list;
    Eigen::Index at = 0;
    for (std::size_t k = 0; k < design.groups().size(); ++k) {
        const ColumnGroup& group = design.group(k);
        if (group.kind != GroupKind::textbook || group.columns() > few ||
            !design.groups()[k].visible() || design.groups()[k].only_form ||
            same_cause(group, held) ||
            std::any_of(rest.members.begin(), rest.members.end(),
                        [&](std::size_t m) { return same_cause(design.group(m), group); }))
            continue;
        list.push_back({k, at, group.columns()});
        at += group.columns();
    }
    return list;
}

/// What the rest of the model leaves of all candidates, side by side.
estimation::GroupInformation left_of(Design& design, const Model& rest,
                                     const std::vector<Candidate>& list) {
    std::vector<std::size_t> groups;
    for (const Candidate& c : list) groups.push_back(c.group);
    const estimation::GroupEquations all = design.equations(groups);
    const estimation::GivenMembers given(design.equations(rest.members), rest.variances);
    return given.leave(design.cross(rest.members, groups), all.gram, all.product);
}

Pair pair_of(const Design& design, const estimation::GroupInformation& all, const Candidate& a,
             const Candidate& b) {
    std::vector<Eigen::Index> columns;
    for (const Candidate* c : {&a, &b})
        for (Eigen::Index k = 0; k < c->count; ++k) columns.push_back(c->first + k);
    const estimation::GroupGain gain =
        estimation::group_gain({all.information(columns, columns), all.product(columns)});
    return {a.group, b.group, gain.tau,
            gain.mean + design.group(a.group).log_prior + design.group(b.group).log_prior};
}

/// The best pairs, best first.
std::vector<Pair> best_pairs(Design& design, const Model& rest, const ColumnGroup& held) {
    const std::vector<Candidate> list = candidates(design, rest, held);
    std::vector<Pair> best;
    if (list.size() < 2) return best;
    const estimation::GroupInformation all = left_of(design, rest, list);
    for (std::size_t b = 1; b < list.size(); ++b)
        for (std::size_t a = 0; a < b; ++a) {
            if (list[a].count + list[b].count > held.columns() ||
                same_cause(design.group(list[a].group), design.group(list[b].group)))
                continue;
            best.push_back(pair_of(design, all, list[a], list[b]));
        }
    std::stable_sort(best.begin(), best.end(),
                     [](const Pair& x, const Pair& y) { return x.value > y.value; });
    if (best.size() > pairs_tuned) best.resize(pairs_tuned);
    return best;
}

}  // namespace

std::vector<TwoInstead> two_instead(Design& design, const SearchSetting& setting,
                                    const Model& model, std::size_t position) {
    const ColumnGroup held = design.group(model.members[position]);
    std::vector<TwoInstead> list;
    const bool angles = held.effect && held.effect->kind == effects::EffectKind::angular;
    const double known = angles ? rules::by_an_arm - rules::effect_prior : 0.0;
    if (held.kind != GroupKind::textbook || held.columns() < 2 ||
        model.members.size() > pairs_up_to)
        return list;
    const Model rest = tuned(design, setting, without(model, position), 1);
    for (const Pair& pair : best_pairs(design, rest, held)) {
        Model trial = rest;
        for (const std::size_t group : {pair.first, pair.second}) {
            trial.members.push_back(group);
            trial.variances.tau.push_back(pair.tau);
        }
        list.push_back(
            {pair.first, pair.second, tuned(design, setting, std::move(trial), 2), known});
    }
    return list;
}

Model without_stand_ins(Design& design, const SearchSetting& setting, Model model) {
    if (model.members.size() > pairs_up_to) return model;
    for (std::size_t position = 0; position < model.members.size() && !setting.stopped();
         ++position) {
        if (design.group(model.members[position]).columns() <= few) continue;
        for (TwoInstead& pair : two_instead(design, setting, model, position)) {
            Model trial = pruned(design, setting, std::move(pair.model));
            if (!(evidence(design, trial) >= evidence(design, model) + better)) continue;
            model = std::move(trial);
            break;
        }
    }
    return model;
}

}  // namespace trunnion::diagnosis

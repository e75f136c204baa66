#include "diagnosis/written_setup.h"

#include <algorithm>

#include "diagnosis/rules.h"
#include "diagnosis/solution.h"

namespace trunnion::diagnosis {
namespace {

/// Limit of the loss on left-out paths, relative to the set-up alone: an effect seen on one path
/// only cannot be predicted there, but does no harm either.
constexpr double most_harm = 1.2;

using TakesMember = std::function<bool(GroupKind, std::size_t group)>;

Model only(const Outcome& f, Model model, const TakesMember& takes) {
    for (std::size_t k = model.members.size(); k-- > 0;)
        if (const std::size_t m = model.members[k]; !takes(f.design.group(m).kind, m))
            model = without(model, k);
    return model;
}

bool holds(const Outcome& f, std::size_t group) {
    const auto at = std::find(f.model.members.begin(), f.model.members.end(), group);
    return f.judgement.interpolates[static_cast<std::size_t>(at - f.model.members.begin())];
}

bool is_large(const Outcome& f, std::size_t group) {
    const auto at = std::find(f.model.members.begin(), f.model.members.end(), group);
    return f.judgement.large[static_cast<std::size_t>(at - f.model.members.begin())];
}

/// Loss on left-out readings when only causes and small zeros predict.
BlockLoss loss_of(const Outcome& f, const Model& model, const Folds& folds) {
    const LeftOut left(f.design, model, folds, f.used);
    std::vector<bool> predicting;
    for (const std::size_t m : model.members) {
        const GroupKind kind = f.design.group(m).kind;
        predicting.push_back(is_cause(kind) || (kind == GroupKind::offset && !is_large(f, m)));
    }
    return left.loss(std::vector<bool>(model.members.size(), true), predicting);
}

bool has_tables(const Outcome& f, const Model& model) {
    return std::any_of(model.members.begin(), model.members.end(),
                       [&](std::size_t m) { return f.design.group(m).kind == GroupKind::table; });
}

bool harms_paths(const Outcome& f, const Model& model, const Model& none) {
    const Folds paths = path_folds(f.prepared.blocks, f.prepared.replay, f.prepared.table.axes);
    return loss_of(f, model, paths).mean() > most_harm * loss_of(f, none, paths).mean();
}

/// The found model without the parts that do not predict, the most complete one first.
std::vector<Model> candidates_of(const Outcome& f) {
    const auto all = [&](GroupKind, std::size_t m) { return holds(f, m); };
    const auto causes = [&](GroupKind k, std::size_t m) {
        return holds(f, m) && k != GroupKind::driver;
    };
    const auto named = [&](GroupKind k, std::size_t) { return k != GroupKind::table; };
    const auto named_causes = [&](GroupKind k, std::size_t) {
        return k != GroupKind::table && k != GroupKind::driver;
    };
    std::vector<Model> list;
    for (const TakesMember& takes :
         {TakesMember(all), TakesMember(causes), TakesMember(named), TakesMember(named_causes)}) {
        Model model = only(f, f.model, takes);
        if (std::any_of(list.begin(), list.end(),
                        [&](const Model& m) { return m.members == model.members; }))
            continue;
        if (model.members != f.model.members)
            model = tuned(f.design, f.setting, std::move(model), 2);
        list.push_back(std::move(model));
    }
    return list;
}

/// The best candidate on left-out readings; the one without causes if none is better.
Model chosen(const Outcome& f) {
    const Model none = only(f, f.model, [&](GroupKind k, std::size_t m) {
        return k == GroupKind::offset && !is_large(f, m);
    });
    const BlockLoss before = loss_of(f, none, f.prepared.folds);
    Model best = none;
    double least = before.mean();
    for (Model& model : candidates_of(f)) {
        const BlockLoss loss = loss_of(f, model, f.prepared.folds);
        if (loss.mean() >= least || saving_of(before, loss).t < rules::least_t) continue;
        if (has_tables(f, model) && harms_paths(f, model, none)) continue;
        least = loss.mean();
        best = std::move(model);
    }
    return best;
}

}  // namespace

setup::Setup written_setup(const Outcome& f) {
    Model model{{}, {{}, f.model.variances.nu}, 0.0};
    if (f.judgement.gap && f.judgement.part > 0.0) model = chosen(f);
    return setup_with(f.prepared, f.design, model, solved(f.design, model));
}

}  // namespace trunnion::diagnosis

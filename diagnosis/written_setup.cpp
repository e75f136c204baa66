#include "diagnosis/written_setup.h"

#include <algorithm>

#include "diagnosis/rules.h"
#include "diagnosis/solution.h"

namespace trunnion::diagnosis {
namespace {

/// Limit of the loss on left-out paths, relative to the set-up alone.
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

/// Which members contribute to a prediction: causes and small zeros.
std::vector<bool> predicting(const Outcome& f, const Model& model) {
    std::vector<bool> list;
    for (const std::size_t m : model.members) {
        const GroupKind kind = f.design.group(m).kind;
        list.push_back(is_cause(kind) || (kind == GroupKind::offset && !is_large(f, m)));
    }
    return list;
}

BlockLoss loss_of(const Outcome& f, const Model& model, const Folds& folds) {
    return LeftOut(f.design, model, folds, f.used)
        .loss(std::vector<bool>(model.members.size(), true), predicting(f, model));
}

Eigen::VectorXd residual_of(const Outcome& f, const Model& model, const Folds& folds) {
    return LeftOut(f.design, model, folds, f.used)
        .residual(std::vector<bool>(model.members.size(), true), predicting(f, model));
}

bool has_tables(const Outcome& f, const Model& model) {
    return std::any_of(model.members.begin(), model.members.end(),
                       [&](std::size_t m) { return f.design.group(m).kind == GroupKind::table; });
}

/// The found model without the parts that do not predict, the most complete one first.
std::vector<Model> candidates_of(const Outcome& f) {
    const auto all = [&](GroupKind, std::size_t m) { return holds(f, m); };
    const auto causes = [&](GroupKind k, std::size_t m) {
        return holds(f, m) && k != GroupKind::driver;
    };
    const auto named = [&](GroupKind k, std::size_t m) {
        return holds(f, m) && k != GroupKind::table;
    };
    const auto named_causes = [&](GroupKind k, std::size_t m) {
        return named(k, m) && k != GroupKind::driver;
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

/// The set-up with the small zeros of tests.
Model without_causes(const Outcome& f) {
    return only(f, f.model, [&](GroupKind k, std::size_t m) {
        return k == GroupKind::offset && !is_large(f, m);
    });
}

/// True when left-out paths deviate from the model by little more than the other paths leave
/// uncertain of them: what one path alone determines cannot be predicted there, but is not refuted.
bool as_expected(const Outcome& f, const Model& model, const Folds& paths, double before) {
    const auto rows = static_cast<double>(std::count(f.used.begin(), f.used.end(), true));
    const double noise = model.variances.nu * model.variances.nu;
    const double beyond = LeftOut(f.design, model, paths, f.used).surprise() / rows - noise;
    return beyond <= (1.0 - rules::explained) * std::max(0.0, before - noise);
}

/// Loss of a candidate on left-out paths (`after`), against the set-up alone (`before`): what was
/// found with tables, and is fitted with or without them, must predict there; known forms alone do
/// no harm, or be as the model expects.
bool holds_elsewhere(const Outcome& f, const Model& model, const Folds& paths, double before,
                     double noise) {
    const double after = loss_of(f, model, paths).mean();
    if (has_tables(f, f.model))
        return before - after >= rules::between_least * std::max(0.0, before - noise);
    // Beside what is missing, a form has an uncertainty that excuses anything.
    return after <= most_harm * before ||
           (f.judgement.part >= rules::explained && as_expected(f, model, paths, before));
}

/// Takes the best candidate on left-out readings that holds on left-out paths, if there is one.
void choose(const Outcome& f, const Folds& paths, Written& w) {
    const double rank = static_cast<double>(f.design.projection().rank());
    const double noise = f.judgement.floor * (1.0 + rank / std::max(1.0, f.design.rows()));
    const BlockLoss before = loss_of(f, w.model, f.prepared.folds);
    const double elsewhere = loss_of(f, w.model, paths).mean();
    double least = before.mean();
    for (Model& model : candidates_of(f)) {
        const BlockLoss loss = loss_of(f, model, f.prepared.folds);
        if (loss.mean() >= least || saving_of(before, loss).t < rules::least_t) continue;
        if (!holds_elsewhere(f, model, paths, elsewhere, noise)) {
            w.only_here = true;
            continue;
        }
        least = loss.mean();
        w.model = std::move(model);
    }
    if (before.mean() > noise) w.part = (before.mean() - least) / (before.mean() - noise);
}

}  // namespace

Written written_setup(const Outcome& f) {
    Written w;
    w.model = {{}, {{}, f.model.variances.nu}, 0.0};
    if (f.judgement.gap && f.judgement.part > 0.0) {
        const Model none = without_causes(f);
        const Folds paths = path_folds(f.prepared.blocks, f.prepared.replay, f.prepared.table.axes);
        w.model = none;
        choose(f, paths, w);
        // A cause is no more likely than this part: rather not there, it is not written.
        if (w.part < rules::partly) w.model = none;
        w.blocks = {f.judgement.left_before, residual_of(f, w.model, f.prepared.folds)};
        w.paths = {residual_of(f, none, paths), residual_of(f, w.model, paths)};
    } else {
        w.blocks = {f.judgement.left_before, f.judgement.left_before};
        w.paths = w.blocks;
    }
    w.setup = setup_with(f.prepared, f.design, w.model, solved(f.design, w.model));
    return w;
}

}  // namespace trunnion::diagnosis

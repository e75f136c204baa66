#include "diagnosis/written_candidates.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "diagnosis/measured_places.h"
#include "diagnosis/rules/rules.h"
#include "diagnosis/search/left_out.h"

namespace trunnion::diagnosis {
namespace {

constexpr double least_agreement = 1.0;  ///< t statistic of a searched form on left-out paths
constexpr double least_part = 0.1;       ///< of its contribution that it must save there

std::size_t position_of(const Outcome& f, std::size_t group) {
    const auto at = std::find(f.model.members.begin(), f.model.members.end(), group);
    return static_cast<std::size_t>(at - f.model.members.begin());
}

bool is_large(const Outcome& f, std::size_t group) {
    return f.judgement.large[position_of(f, group)];
}

std::vector<bool> predicting(const Outcome& f, const Model& model, Zeros zeros) {
    std::vector<bool> list;
    for (const std::size_t m : model.members) {
        const GroupKind kind = f.design.group(m).kind;
        const bool zero = kind == GroupKind::offset && (zeros == Zeros::all || !is_large(f, m));
        list.push_back(is_cause(kind) || zero);
    }
    return list;
}

}  // namespace

Model only(const Outcome& f, Model model, const TakesMember& takes) {
    for (std::size_t k = model.members.size(); k-- > 0;)
        if (const std::size_t m = model.members[k]; !takes(f.design.group(m).kind, m))
            model = without(model, k);
    return model;
}

BlockLoss loss_of(const Outcome& f, const Model& model, const Folds& folds) {
    return LeftOut(f.design, model, folds, f.used)
        .loss(std::vector<bool>(model.members.size(), true), predicting(f, model, Zeros::all));
}

BlockLoss loss_on_paths(const Outcome& f, const Model& model, const Folds& paths) {
    return LeftOut(f.design, model, paths, f.used)
        .loss_beside_set_up(std::vector<bool>(model.members.size(), true),
                            predicting(f, model, Zeros::all));
}

Eigen::VectorXd residual_of(const Outcome& f, const Model& model, const Folds& folds, Zeros zeros) {
    return LeftOut(f.design, model, folds, f.used)
        .residual(std::vector<bool>(model.members.size(), true), predicting(f, model, zeros));
}

namespace {

/// True for what was chosen among many forms, so that it fits what other causes leave, too.
bool has_searched_form(GroupKind kind) {
    return kind == GroupKind::table || kind == GroupKind::periodic;
}

/// Squares that a searched form saves on left-out paths: more than their scatter, and a part of
/// what it contributes to the model.
bool helps(const Saving& saving, double contribution) {
    return saving.t >= least_agreement && saving.sum >= least_part * contribution;
}

/// For each member: whether it predicts between its positions, or may be written for them alone,
/// and, where its form was searched, helps on left-out paths. What does not help is dropped one by
/// one, the worst first.
std::vector<bool> predicting_elsewhere(const Outcome& f, const Folds& paths) {
    const std::vector<bool> counts = predicting(f, f.model, Zeros::all);
    const Eigen::MatrixXd parts = contributions(f.design, f.model, fit_of(f.design, f.model));
    const LeftOut left(f.design, f.model, paths, f.used);
    const auto loss = [&](const std::vector<bool>& fitted) {
        std::vector<bool> predicts = counts;
        for (std::size_t k = 0; k < fitted.size(); ++k) predicts[k] = predicts[k] && fitted[k];
        return left.loss_beside_set_up(fitted, predicts);
    };
    std::vector<bool> kept = f.judgement.interpolates;
    for (std::size_t k = 0; k < kept.size(); ++k)
        kept[k] = kept[k] || holds_at_places(f, f.model.members[k]);
    // What holds at the places alone does there what the others do, and says nothing of them.
    const auto between = [&] {
        std::vector<bool> list = kept;
        for (std::size_t k = 0; k < list.size(); ++k)
            list[k] = list[k] && f.judgement.interpolates[k];
        return list;
    };
    for (;;) {
        const std::vector<bool> elsewhere = between();
        const BlockLoss with_all = loss(kept), with_those = loss(elsewhere);
        std::optional<std::size_t> worst;
        double least = 1e300;
        for (std::size_t k = 0; k < kept.size(); ++k) {
            if (!kept[k] || !has_searched_form(f.design.group(f.model.members[k]).kind)) continue;
            const bool local = !f.judgement.interpolates[k];
            std::vector<bool> rest = local ? kept : elsewhere;
            rest[k] = false;
            const Saving saving = saving_of(loss(rest), local ? with_all : with_those);
            const double contribution = parts.col(static_cast<Eigen::Index>(k)).squaredNorm();
            if (helps(saving, contribution) || saving.t >= least) continue;
            least = saving.t;
            worst = k;
        }
        if (!worst) return kept;
        kept[*worst] = false;
    }
}

}  // namespace

namespace {

Model without_enormous(const Outcome& f, const SearchSetting& setting, Model model) {
    const std::vector<double> found = usual_sizes(f.design, f.model);
    const auto was_enormous = [&](std::size_t group) {
        const std::size_t at = position_of(f, group);
        return at < found.size() && found[at] > rules::enormous;
    };
    for (bool again = true; again;) {
        model = tuned(f.design, setting, std::move(model), 2);
        const std::vector<double> sizes = usual_sizes(f.design, model);
        again = false;
        for (std::size_t k = model.members.size(); k-- > 0;) {
            const std::size_t m = model.members[k];
            if (!is_cause(f.design.group(m).kind) || sizes[k] <= rules::enormous || was_enormous(m))
                continue;
            model = without(model, k);
            again = true;
        }
    }
    return model;
}

/// True where rows that nothing taken out moves answer to what is kept: of another axis, perhaps.
bool has_rows_of_its_own(const Outcome& f, const Model& kept) {
    std::vector<std::size_t> own, out;
    for (const std::size_t m : f.model.members) {
        const bool stays = std::count(kept.members.begin(), kept.members.end(), m) > 0;
        if (is_cause(f.design.group(m).kind)) (stays ? own : out).push_back(m);
    }
    const std::vector<bool> moved = moved_rows(f.design, own), others = moved_rows(f.design, out);
    for (std::size_t i = 0; i < moved.size(); ++i)
        if (moved[i] && !others[i]) return true;
    return false;
}

/// The setting with the noise that was found: what is taken out on purpose is no noise, which would
/// make all that is kept smaller.
SearchSetting with_found_noise(const Outcome& f) {
    constexpr double spread = 1e-3;
    SearchSetting setting = f.setting;
    setting.noise.log_mean = std::log(f.model.variances.nu);
    setting.noise.spread = spread;
    return setting;
}

}  // namespace

Model without_enormous(const Outcome& f, Model model) {
    return without_enormous(f, f.setting, std::move(model));
}

namespace {

/// The model with the textbook forms of the tables that were found: a few numbers may hold where
/// the curve does not.
Model with_textbook_forms(const Outcome& f, Model model) {
    for (const std::size_t m : f.model.members) {
        const ColumnGroup& table = f.design.group(m);
        if (table.kind != GroupKind::table) continue;
        for (std::size_t k = 0; k < f.design.groups().size(); ++k) {
            const Design::Entry& entry = f.design.groups()[k];
            if (entry.group.kind != GroupKind::textbook || entry.group.name != table.name ||
                entry.group.is_change() || entry.hidden || !entry.visible() ||
                std::count(model.members.begin(), model.members.end(), k) > 0)
                continue;
            model.members.push_back(k);
            model.variances.tau.push_back(1.0);
        }
    }
    return model;
}

}  // namespace

std::vector<WrittenCandidate> candidates_of(const Outcome& f, const Folds& paths) {
    const std::vector<bool> kept = predicting_elsewhere(f, paths);
    const auto all = [&](GroupKind, std::size_t m) { return bool{kept[position_of(f, m)]}; };
    const auto causes = [&](GroupKind k, std::size_t m) {
        return all(k, m) && k != GroupKind::driver;
    };
    const auto named = [&](GroupKind k, std::size_t m) {
        return all(k, m) && k != GroupKind::table;
    };
    const auto named_causes = [&](GroupKind k, std::size_t m) {
        return named(k, m) && k != GroupKind::driver;
    };
    std::vector<WrittenCandidate> list;
    const auto add = [&](Model model, bool found) {
        if (std::any_of(list.begin(), list.end(), [&](const WrittenCandidate& c) {
                return c.model.members == model.members;
            }))
            return;
        if (model.members != f.model.members) {
            if (has_rows_of_its_own(f, model))
                list.push_back({without_enormous(f, with_found_noise(f), model), found});
            model = without_enormous(f, std::move(model));
        }
        list.push_back({std::move(model), found});
    };
    for (const TakesMember& takes :
         {TakesMember(all), TakesMember(causes), TakesMember(named), TakesMember(named_causes)})
        add(only(f, f.model, takes), true);
    add(with_textbook_forms(f, only(f, f.model, named)), false);
    return list;
}

}  // namespace trunnion::diagnosis

#include "diagnosis/written_setup.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "base/alarm.h"
#include "diagnosis/doubted.h"
#include "diagnosis/measured_places.h"
#include "diagnosis/prepare/target_visits.h"
#include "diagnosis/rules/rules.h"
#include "diagnosis/search/solution.h"
#include "diagnosis/set_up_alone.h"
#include "effects/settings.h"
#include "estimation/quantiles.h"

namespace trunnion::diagnosis {
namespace {

/// Limit of the loss on left-out paths, relative to the set-up alone.
constexpr double most_harm = 1.2;
constexpr double least_agreement = 1.0;  ///< t statistic of a searched form on left-out paths
constexpr double least_part = 0.1;       ///< of its contribution that it must save there

using TakesMember = std::function<bool(GroupKind, std::size_t group)>;

Model only(const Outcome& f, Model model, const TakesMember& takes) {
    for (std::size_t k = model.members.size(); k-- > 0;)
        if (const std::size_t m = model.members[k]; !takes(f.design.group(m).kind, m))
            model = without(model, k);
    return model;
}

std::size_t position_of(const Outcome& f, std::size_t group) {
    const auto at = std::find(f.model.members.begin(), f.model.members.end(), group);
    return static_cast<std::size_t>(at - f.model.members.begin());
}

bool is_large(const Outcome& f, std::size_t group) {
    return f.judgement.large[position_of(f, group)];
}

/// Which members contribute to a prediction: causes, and zeros. What is to be written is judged
/// beside all zeros; the gap contains the large ones.
enum class Zeros : unsigned char { all, small };
std::vector<bool> predicting(const Outcome& f, const Model& model, Zeros zeros) {
    std::vector<bool> list;
    for (const std::size_t m : model.members) {
        const GroupKind kind = f.design.group(m).kind;
        const bool zero = kind == GroupKind::offset && (zeros == Zeros::all || !is_large(f, m));
        list.push_back(is_cause(kind) || zero);
    }
    return list;
}

BlockLoss loss_of(const Outcome& f, const Model& model, const Folds& folds) {
    return LeftOut(f.design, model, folds, f.used)
        .loss(std::vector<bool>(model.members.size(), true), predicting(f, model, Zeros::all));
}

Eigen::VectorXd residual_of(const Outcome& f, const Model& model, const Folds& folds,
                            Zeros zeros = Zeros::small) {
    return LeftOut(f.design, model, folds, f.used)
        .residual(std::vector<bool>(model.members.size(), true), predicting(f, model, zeros));
}

bool has_tables(const Outcome& f, const Model& model) {
    return std::any_of(model.members.begin(), model.members.end(),
                       [&](std::size_t m) { return f.design.group(m).kind == GroupKind::table; });
}

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
        return left.loss(fitted, predicts);
    };
    std::vector<bool> kept = f.judgement.interpolates;
    for (std::size_t k = 0; k < kept.size(); ++k)
        kept[k] = kept[k] || holds_at_places(f, f.model.members[k]);
    for (BlockLoss with = loss(kept);; with = loss(kept)) {
        std::optional<std::size_t> worst;
        double least = 1e300;
        for (std::size_t k = 0; k < kept.size(); ++k) {
            if (!kept[k] || !has_searched_form(f.design.group(f.model.members[k]).kind)) continue;
            std::vector<bool> rest = kept;
            rest[k] = false;
            const Saving saving = saving_of(loss(rest), with);
            const double contribution = parts.col(static_cast<Eigen::Index>(k)).squaredNorm();
            if (helps(saving, contribution) || saving.t >= least) continue;
            least = saving.t;
            worst = k;
        }
        if (!worst) return kept;
        kept[*worst] = false;
    }
}

/// A changed model, tuned, without members that are many times the usual size only there: without
/// what was taken out, the readings do not tell how large they are.
Model without_enormous(const Outcome& f, Model model) {
    const std::vector<double> found = usual_sizes(f.design, f.model);
    const auto was_enormous = [&](std::size_t group) {
        const std::size_t at = position_of(f, group);
        return at < found.size() && found[at] > rules::enormous;
    };
    for (bool again = true; again;) {
        model = tuned(f.design, f.setting, std::move(model), 2);
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

struct WrittenCandidate {
    Model model;
    bool found = true;  ///< false: with forms that the search did not choose
};

/// The found model without the parts that do not predict, the most complete one first.
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
        if (model.members != f.model.members) model = without_enormous(f, std::move(model));
        list.push_back({std::move(model), found});
    };
    for (const TakesMember& takes :
         {TakesMember(all), TakesMember(causes), TakesMember(named), TakesMember(named_causes)})
        add(only(f, f.model, takes), true);
    add(with_textbook_forms(f, only(f, f.model, named)), false);
    return list;
}

/// The set-up with all zeros.
Model without_causes(const Outcome& f) {
    return only(f, f.model, [](GroupKind k, std::size_t) { return k == GroupKind::offset; });
}

/// True when left-out paths deviate from the model by little more than the other paths leave
/// uncertain of them: what one path alone determines cannot be predicted there, but is not refuted.
bool as_expected(const Outcome& f, const Model& model, const Folds& paths, double before) {
    const auto rows = static_cast<double>(std::count(f.used.begin(), f.used.end(), true));
    const double noise = model.variances.nu * model.variances.nu;
    const double beyond = LeftOut(f.design, model, paths, f.used).surprise() / rows - noise;
    return beyond <= (1.0 - rules::explained) * std::max(0.0, before - noise);
}

/// Loss of the set-up alone on left-out blocks and on left-out paths, and of the noise.
struct Alone {
    double blocks = 0.0, paths = 0.0, noise = 0.0;
};

/// Parts of the readings that are left out as a whole. Where all passes are over one path, there is
/// no other one to predict it from: then each pass. Of a laser or an angle sensor on one axis,
/// whose passes lead over the same places, those blocks of which others see the places: nothing
/// predicts an end of the travel that is left out in all passes.
struct Paths {
    Folds folds;
    bool one = false;
};

Paths paths_of(const Prepared& p) {
    if (!p.cycle.empty() && p.cycle.back() > 0) return {p.folds};
    Paths paths{path_folds(p.blocks, p.replay, p.table.axes)};
    // Both ways over a target are one path: where both were left out, its form is not known.
    spread_visits(p.blocks, p.replay, p.table, paths.folds);
    std::vector<int>& fold = paths.folds.fold;
    paths.one = std::adjacent_find(fold.begin(), fold.end(), std::not_equal_to<>()) == fold.end();
    if (paths.one)
        for (std::size_t k = 0; k < fold.size(); ++k) fold[k] = static_cast<int>(k) % Folds::count;
    return paths;
}

/// What was found with tables, and is fitted with or without them, must leave at most half of the
/// gap on left-out paths, seen on these or within the paths: where the set-up alone misses them by
/// more than the gap, they say nothing of a gap. Known forms alone do no harm, or are as the model
/// expects. A table of one path says nothing of others.
bool holds_elsewhere(const Outcome& f, const Model& model, const Paths& paths, const Alone& alone) {
    const double after = loss_of(f, model, paths.folds).mean();
    // What known forms explain without the tables does not rest on these.
    const double own = alone.blocks - loss_of(f, model, f.prepared.folds).mean();
    const bool known_forms =
        !has_tables(f, model) && own >= rules::explained * (alone.blocks - alone.noise);
    if (has_tables(f, f.model) && !known_forms) {
        if (paths.one) return false;
        const double gap = std::min(alone.blocks, alone.paths) - alone.noise;
        return after - alone.noise <= (1.0 - rules::between_least) * std::max(0.0, gap);
    }
    // Beside what is missing, a form has an uncertainty that excuses anything.
    return after <= most_harm * alone.paths || (f.judgement.part >= rules::explained &&
                                                as_expected(f, model, paths.folds, alone.paths));
}

/// True when a model predicts the typical left-out reading no worse: what helps a few readings that
/// are far off must not be at the expense of the others. No reading counts more than three
/// deviations.
bool is_good_for_most(const Outcome& f, const Eigen::VectorXd& before,
                      const Eigen::VectorXd& after) {
    std::vector<double> size;
    for (std::size_t i = 0; i < f.used.size(); ++i)
        if (f.used[i]) size.push_back(before(static_cast<Eigen::Index>(i)));
    const double most =
        3.0 * std::max(std::sqrt(f.judgement.floor), estimation::robust_deviation(std::move(size)));
    double saved = 0.0;
    for (std::size_t i = 0; i < f.used.size(); ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        if (!f.used[i]) continue;
        saved += std::pow(std::min(most, std::abs(before(row))), 2) -
                 std::pow(std::min(most, std::abs(after(row))), 2);
    }
    return saved > 0.0;
}

/// True where left-out blocks confirm a candidate. What one block alone shows of an effect, the
/// start of the only move of a log, makes the saving large, not doubtful.
bool is_confirmed(const BlockLoss& before, const BlockLoss& loss) {
    return std::max(saving_of(before, loss).t, steady_saving_of(before, loss).t) >= rules::least_t;
}

/// Takes the best candidate on left-out readings that holds on left-out paths, if there is one.
void choose(const Outcome& f, const Paths& paths, Written& w) {
    const double rank = static_cast<double>(f.design.projection().rank());
    const double noise = f.judgement.floor * (1.0 + rank / std::max(1.0, f.design.rows()));
    const BlockLoss before = loss_of(f, w.model, f.prepared.folds);
    const Alone alone{before.mean(), loss_of(f, w.model, paths.folds).mean(), noise};
    const auto left = [&](const Model& m) {
        return residual_of(f, m, f.prepared.folds, Zeros::all);
    };
    const Eigen::VectorXd alone_left = left(w.model);
    double least = alone.blocks;
    for (auto& [model, found] : candidates_of(f, paths.folds)) {
        const BlockLoss loss = loss_of(f, model, f.prepared.folds);
        if (loss.mean() >= least || !is_confirmed(before, loss)) continue;
        if (!is_good_for_most(f, alone_left, left(model))) continue;
        if (!holds_elsewhere(f, model, paths, alone)) {
            w.only_here = w.only_here || (found && saving_of(before, loss).t >= rules::least_t);
            continue;
        }
        least = loss.mean();
        w.model = std::move(model);
    }
    if (alone.blocks > noise) w.part = (alone.blocks - least) / (alone.blocks - noise);
}

bool has_causes(const Outcome& f, const Model& model) {
    return std::any_of(model.members.begin(), model.members.end(),
                       [&](std::size_t m) { return is_cause(f.design.group(m).kind); });
}

setup::Setup setup_of(const Outcome& f, const Model& model) {
    std::vector<bool> at_places;
    for (const std::size_t m : model.members) at_places.push_back(holds_at_places(f, m));
    return has_causes(f, model)
               ? setup_with(f.prepared, f.design, model, solved(f.design, model), at_places)
               : set_up_alone(f);
}

/// What the emulator leaves with a setup beyond what the model leaves, mm; but for zeros of tests.
Eigen::VectorXd bend_of(const Outcome& f, const Model& model, const setup::Setup& setup) {
    const Prepared& p = f.prepared;
    const Solution solution = solved(f.design, model);
    const std::vector<double> read = p.replay.predict(
        setup.machine, identification::offsets_to(p.replay, setup), effects::active_models(setup));
    const Eigen::Map<const Eigen::VectorXd> bent(read.data(), p.base.measured_mm.size());
    Eigen::VectorXd bend = p.base.measured_mm - bent - left_mm(p, f.design, model, solution);
    free_zeros(p.replay, p.base.sigma_mm, bend);
    return bend;
}

/// The same setup with its poses and zeros fitted again, where the emulator reads it otherwise than
/// the model: these move far along directions that readings hardly show, and are not linear there.
setup::Setup read_again(const Outcome& f, const Model& model, setup::Setup setup) {
    constexpr double least_bend = 0.25;  // of a sigma
    const Prepared& p = f.prepared;
    const Eigen::VectorXd bend = bend_of(f, model, setup).cwiseQuotient(p.base.sigma_mm);
    if (!(bend.cwiseAbs().maxCoeff() > least_bend)) return setup;
    try {
        return identification::fit_base(setup, p.table, p.replay, p.catalogue, setup.model.modelled)
            .setup;
    } catch (const InputError&) {
        return setup;  // implausible: holds_when_read() decides
    }
}

/// False where the causes of a model, read by the emulator, leave more than none: errors of degrees
/// or millimetres are not linear. `setup`: with the model, for all sessions alike.
bool holds_when_read(const Outcome& f, const Model& model, const setup::Setup& setup) {
    const Prepared& p = f.prepared;
    const Solution solution = solved(f.design, model);
    const Eigen::VectorXd bend = bend_of(f, model, setup);
    Eigen::VectorXd left = f.design.data() - f.design.known() * solution.mean.head(solution.known);
    for (std::size_t k = 0; k < model.members.size(); ++k)
        if (is_cause(f.design.group(model.members[k]).kind))
            left -= f.design.combined(model.members[k],
                                      solution.mean.segment(solution.first[k], solution.size[k]));
    for (Eigen::Index i = 0; i < bend.size(); ++i) {
        const records::Device device = p.replay.contact(static_cast<std::size_t>(i)).device;
        left(i) += bend(i) / (f.noise.model.of(device).scale * p.base.sigma_mm(i));
    }
    return left.squaredNorm() < f.design.projection().beside(f.design.data()).squaredNorm();
}

bool has_changes(const Outcome& f, const Model& model) {
    return std::any_of(model.members.begin(), model.members.end(),
                       [&](std::size_t m) { return f.design.group(m).is_change(); });
}

}  // namespace

Written written_setup(const Outcome& f) {
    Written w;
    w.model = {{}, {{}, f.model.variances.nu}, 0.0};
    if (f.judgement.gap && std::max(f.judgement.part, f.judgement.beside_zeros) > 0.0) {
        const Model none = without_causes(f);
        const Paths paths = paths_of(f.prepared);
        w.model = none;
        choose(f, paths, w);
        // A cause is no more likely than this part: rather not there, it is not written. Where the
        // rest holds at the measured places only, the part without it says nothing of a cause.
        if (w.part < rules::partly && f.judgement.between_places && !w.only_here) w.model = none;
        w.setup = setup_of(f, w.model);
        const bool causes = has_causes(f, w.model) && !has_changes(f, w.model);
        if (causes) w.setup = read_again(f, w.model, std::move(w.setup));
        if (causes && !holds_when_read(f, w.model, w.setup)) {
            w.model = none;
            w.part = 0.0;
            w.setup = set_up_alone(f);
        }
        w.blocks = {f.judgement.left_before, residual_of(f, w.model, f.prepared.folds)};
        w.paths = {residual_of(f, none, paths.folds), residual_of(f, w.model, paths.folds)};
    } else {
        w.setup = set_up_alone(f);
        w.blocks = {f.judgement.left_before, f.judgement.left_before};
        w.paths = w.blocks;
    }
    return w;
}

}  // namespace trunnion::diagnosis

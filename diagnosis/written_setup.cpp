#include "diagnosis/written_setup.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "base/alarm.h"
#include "diagnosis/background.h"
#include "diagnosis/doubted.h"
#include "diagnosis/measured_places.h"
#include "diagnosis/prepare/target_visits.h"
#include "diagnosis/rules/rules.h"
#include "diagnosis/search/left_out.h"
#include "diagnosis/search/solution.h"
#include "diagnosis/set_up_alone.h"
#include "diagnosis/written_candidates.h"
#include "effects/settings.h"
#include "estimation/quantiles.h"

namespace trunnion::diagnosis {
namespace {

/// Limit of the loss on left-out paths, relative to the set-up alone.
constexpr double most_harm = 1.2;

bool has_tables(const Outcome& f, const Model& model) {
    return std::any_of(model.members.begin(), model.members.end(),
                       [&](std::size_t m) { return f.design.group(m).kind == GroupKind::table; });
}

/// The set-up with all zeros.
Model without_causes(const Outcome& f) {
    return only(f, f.model, [](GroupKind k, std::size_t) { return k == GroupKind::offset; });
}

/// Readings that may be left out.
double rows_of(const Outcome& f, const Folds& folds) {
    double rows = 0.0;
    for (std::size_t i = 0; i < f.used.size(); ++i)
        if (f.used[i] && folds.group[i] >= 0) rows += 1.0;
    return rows;
}

/// True when left-out paths deviate from the model by little more than the other paths leave
/// uncertain of them: what one path alone determines cannot be predicted there, but is not refuted.
bool as_expected(const Outcome& f, const Model& model, const Folds& paths, double before) {
    const double noise = model.variances.nu * model.variances.nu;
    const double beyond =
        LeftOut(f.design, model, paths, f.used).surprise() / rows_of(f, paths) - noise;
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

/// What is left out on the rows that a candidate can move: others, of another axis perhaps, say
/// nothing of it.
struct Judges {
    Folds blocks;
    Paths paths;
    Alone alone;
};

Alone alone_on(const Outcome& f, const Folds& blocks, const Folds& paths) {
    const Model none = without_causes(f);
    const double rank = static_cast<double>(f.design.projection().rank());
    return {loss_of(f, none, blocks).mean(), loss_on_paths(f, none, paths).mean(),
            f.judgement.floor * (1.0 + rank / std::max(1.0, f.design.rows()))};
}

Judges judges_of(const Outcome& f, const Model& model, const Judges& all) {
    std::vector<std::size_t> causes;
    for (const std::size_t m : model.members)
        if (is_cause(f.design.group(m).kind)) causes.push_back(m);
    Judges own{of_moved_rows(f.design, causes, all.blocks),
               {of_moved_rows(f.design, causes, all.paths.folds), all.paths.one},
               all.alone};
    if (causes.empty() || own.blocks.group == all.blocks.group) return all;
    own.alone = alone_on(f, own.blocks, own.paths.folds);
    return own;
}

/// True where left-out paths save at least half of what the causes of a model do at all readings:
/// then they are there, however much of the gap has another cause.
bool does_what_it_says(const Outcome& f, const Model& model, const Judges& by,
                       const BlockLoss& after) {
    const Eigen::MatrixXd parts = contributions(f.design, model, fit_of(f.design, model));
    Eigen::VectorXd causes = Eigen::VectorXd::Zero(parts.rows());
    for (std::size_t k = 0; k < model.members.size(); ++k)
        if (is_cause(f.design.group(model.members[k]).kind))
            causes += parts.col(static_cast<Eigen::Index>(k));
    const Saving saving = saving_of(loss_on_paths(f, without_causes(f), by.paths.folds), after);
    return saving.t >= rules::least_t && saving.sum >= rules::between_least * causes.squaredNorm();
}

/// What was found with tables, and is fitted with or without them, must leave at most half of the
/// gap on left-out paths, seen on these or within the paths: where the set-up alone misses them by
/// more than the gap, they say nothing of a gap. Or it saves there what it does here. Known forms
/// alone do no harm, or are as the model expects. A table of one path says nothing of others.
bool holds_elsewhere(const Outcome& f, const Model& model, const Judges& by) {
    const Alone& alone = by.alone;
    const BlockLoss left = loss_on_paths(f, model, by.paths.folds);
    const double after = left.mean();
    // What known forms explain without the tables does not rest on these.
    const double own = alone.blocks - loss_of(f, model, by.blocks).mean();
    const bool known_forms =
        !has_tables(f, model) && own >= rules::explained * (alone.blocks - alone.noise);
    if (has_tables(f, f.model) && !known_forms) {
        if (by.paths.one) return false;
        const double gap = std::min(alone.blocks, alone.paths) - alone.noise;
        return after - alone.noise <= (1.0 - rules::between_least) * std::max(0.0, gap) ||
               does_what_it_says(f, model, by, left);
    }
    // Beside what is missing, a form has an uncertainty that excuses anything.
    return after <= most_harm * alone.paths || (f.judgement.part >= rules::explained &&
                                                as_expected(f, model, by.paths.folds, alone.paths));
}

/// Three deviations of the readings of each device: no reading counts more. Those of another device
/// may be of another size altogether.
std::map<records::Device, double> most_of_devices(const Outcome& f, const Eigen::VectorXd& before) {
    std::map<records::Device, std::vector<double>> sizes;
    for (std::size_t i = 0; i < f.used.size(); ++i)
        if (f.used[i])
            sizes[f.prepared.replay.contact(i).device].push_back(
                before(static_cast<Eigen::Index>(i)));
    std::map<records::Device, double> most;
    for (auto& [device, size] : sizes)
        most[device] = 3.0 * std::max(std::sqrt(f.judgement.floor),
                                      estimation::robust_deviation(std::move(size)));
    return most;
}

/// True when a model predicts the typical left-out reading no worse: what helps a few readings that
/// are far off must not be at the expense of the others.
bool is_good_for_most(const Outcome& f, const Eigen::VectorXd& before,
                      const Eigen::VectorXd& after) {
    const std::map<records::Device, double> most = most_of_devices(f, before);
    double saved = 0.0;
    for (std::size_t i = 0; i < f.used.size(); ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        if (!f.used[i]) continue;
        const double limit = most.at(f.prepared.replay.contact(i).device);
        saved += std::pow(std::min(limit, std::abs(before(row))), 2) -
                 std::pow(std::min(limit, std::abs(after(row))), 2);
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
    const BlockLoss before = loss_of(f, w.causes, f.prepared.folds);
    const Judges all{f.prepared.folds, paths, alone_on(f, f.prepared.folds, paths.folds)};
    const double noise = all.alone.noise;
    const auto left = [&](const Model& m) {
        return residual_of(f, m, f.prepared.folds, Zeros::all);
    };
    const Eigen::VectorXd alone_left = left(w.causes);
    double least = before.mean();
    for (auto& [model, found] : candidates_of(f, paths.folds)) {
        const BlockLoss loss = loss_of(f, model, f.prepared.folds);
        if (loss.mean() >= least || !is_confirmed(before, loss)) continue;
        if (!is_good_for_most(f, alone_left, left(model))) continue;
        if (!holds_elsewhere(f, model, judges_of(f, model, all))) {
            w.only_here = w.only_here || (found && saving_of(before, loss).t >= rules::least_t);
            continue;
        }
        least = loss.mean();
        w.causes = std::move(model);
    }
    if (before.mean() > noise) w.part = (before.mean() - least) / (before.mean() - noise);
}

bool has_causes(const Outcome& f, const Model& model) {
    return std::any_of(model.members.begin(), model.members.end(),
                       [&](std::size_t m) { return is_cause(f.design.group(m).kind); });
}

/// Log likelihood of a model, without the priors of its members.
double likelihood_of(const Outcome& f, const Model& model) {
    const Model best = tuned(f.design, f.setting, model, 1);
    double likelihood = best.score;
    for (std::size_t k = 0; k < best.members.size(); ++k) {
        const ColumnGroup& group = f.design.group(best.members[k]);
        likelihood -= group.log_prior + log_prior_of_size(group, best.variances.tau[k]);
    }
    return likelihood;
}

/// The causes with small errors of all axes, where these help left-out blocks and do not harm
/// left-out paths; else the causes alone. Their sizes are fitted to all readings, those that are
/// left out too: the likelihood must gain more than so many sizes gain of noise.
Model beside_small_errors(const Outcome& f, const Paths& paths, const Model& causes) {
    if (paths.one || !has_causes(f, causes)) return causes;
    Model whole = with_background(f, causes);
    if (whole.members.size() == causes.members.size()) return causes;
    const auto added = static_cast<double>(whole.members.size() - causes.members.size());
    if (likelihood_of(f, whole) - likelihood_of(f, causes) <
        rules::least_evidence + rules::size_of_noise * added)
        return causes;
    const Folds& blocks = f.prepared.folds;
    const Saving saving = saving_of(loss_of(f, causes, blocks), loss_of(f, whole, blocks));
    const Saving elsewhere =
        saving_of(loss_on_paths(f, causes, paths.folds), loss_on_paths(f, whole, paths.folds));
    const bool helps = saving.t >= rules::background_t && elsewhere.t >= -rules::background_t;
    return helps ? whole : causes;
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

/// The setup of the written model, and what it leaves of left-out readings.
void write_out(const Outcome& f, const Paths& paths, Written& w) {
    const Model none = without_causes(f);
    w.model = beside_small_errors(f, paths, w.causes);
    w.setup = setup_of(f, w.model);
    const bool causes = has_causes(f, w.model) && !has_changes(f, w.model);
    if (causes) w.setup = read_again(f, w.model, std::move(w.setup));
    if (causes && !holds_when_read(f, w.model, w.setup)) {
        w.causes = w.model = none;
        w.part = 0.0;
        w.setup = set_up_alone(f);
    }
    w.background = names_beside(f.design, w.model, w.causes);
    w.blocks = {f.judgement.left_before, residual_of(f, w.model, f.prepared.folds)};
    w.paths = {residual_of(f, none, paths.folds), residual_of(f, w.model, paths.folds)};
}

/// Positions of members that are rather one of their rivals, or nothing.
std::vector<std::size_t> unlikely_of(const std::vector<Claim>& claims) {
    std::vector<std::size_t> positions;
    for (const Claim& claim : claims)
        if (claim.probability < rules::rather_not) positions.push_back(claim.position);
    return positions;
}

/// The best model without a member, of those forms that may be written: what stands in the model,
/// and textbook forms.
std::optional<Model> instead_of_member(const Outcome& f, const Model& model, std::size_t position) {
    const Model& other = f.found.contenders[position].model;
    if (other.members.empty()) return std::nullopt;
    return without_enormous(
        f, only(f, other, [&](GroupKind kind, std::size_t m) {
            const bool held = std::count(model.members.begin(), model.members.end(), m) > 0;
            return (held && m != f.model.members[position]) ||
                   (kind == GroupKind::textbook && !f.design.groups()[m].only_rival);
        }));
}

}  // namespace

Written written_setup(const Outcome& f) {
    Written w;
    w.causes = w.model = {{}, {{}, f.model.variances.nu}, 0.0};
    if (f.judgement.gap && std::max(f.judgement.part, f.judgement.beside_zeros) > 0.0) {
        const Paths paths = paths_of(f.prepared);
        w.causes = without_causes(f);
        choose(f, paths, w);
        // A cause is no more likely than this part: rather not there, it is not written. Where the
        // rest holds at the measured places only, the part without it says nothing of a cause.
        if (w.part < rules::partly && f.judgement.between_places && !w.only_here)
            w.causes = without_causes(f);
        write_out(f, paths, w);
    } else {
        w.setup = set_up_alone(f);
        w.blocks = {f.judgement.left_before, f.judgement.left_before};
        w.paths = w.blocks;
    }
    return w;
}

double confirmed_part(const Outcome& f, const Written& written,
                      const records::ReadingTable& holdout) {
    const double part = measured_part(f, written.setup, holdout);
    const bool has_all = std::all_of(f.model.members.begin(), f.model.members.end(), [&](auto m) {
        return !is_cause(f.design.group(m).kind) ||
               std::count(written.model.members.begin(), written.model.members.end(), m) > 0;
    });
    if (has_all) return part;
    const setup::Setup all = setup_with(f.prepared, f.design, f.model, solved(f.design, f.model));
    return std::max(part, measured_part(f, all, holdout));
}

Written without_unlikely(const Outcome& f, Written written, const std::vector<Claim>& claims) {
    Model model = written.causes;
    for (const std::size_t position : unlikely_of(claims)) {
        const std::size_t group = f.model.members[position];
        const auto at = std::find(model.members.begin(), model.members.end(), group);
        if (at == model.members.end()) continue;
        const BlockLoss with = loss_of(f, model, f.prepared.folds);
        const auto is_missed = [&](const Model& rest) {
            return !has_causes(f, rest) ||
                   saving_of(loss_of(f, rest, f.prepared.folds), with).t >= rules::least_t;
        };
        std::optional<Model> rest = without_enormous(
            f, without(model, static_cast<std::size_t>(at - model.members.begin())));
        if (is_missed(*rest)) rest = instead_of_member(f, model, position);
        if (rest && !is_missed(*rest)) model = std::move(*rest);
    }
    if (model.members == written.causes.members) return written;
    written.causes = std::move(model);
    write_out(f, paths_of(f.prepared), written);
    return written;
}

}  // namespace trunnion::diagnosis

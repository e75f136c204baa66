// The pipeline: prepare -> noise -> search -> judgement -> claims -> interval -> verdict.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "diagnosis/candidate_groups.h"
#include "diagnosis/changes.h"
#include "diagnosis/diagnosis_report.h"
#include "diagnosis/key_search.h"
#include "diagnosis/machine_jump.h"
#include "diagnosis/open_sides.h"
#include "diagnosis/outliers.h"
#include "diagnosis/ripples.h"
#include "diagnosis/rules.h"
#include "diagnosis/solution.h"
#include "diagnosis/store_gap.h"
#include "diagnosis/thinning.h"
#include "diagnosis/verdict.h"
#include "effects/settings.h"
#include "identification/identify.h"

namespace trunnion::diagnosis {
namespace {

/// From a longer table this number is selected evenly: enough to identify causes of a hundredth of
/// the noise.
constexpr std::size_t most_readings = 10000;
constexpr int most_rounds = 3;       ///< of search, noise and linearisation
constexpr double most_bent = 3.0;    ///< growth of the residual by a prediction that is not linear
constexpr double bend_sigma = 0.25;  ///< of a reading: a smaller nonlinearity is ignored
constexpr double outlier_sigma = 1e3;  ///< sigma of an excluded reading, relative to its own
constexpr int first_keys = 2;

/// Rows, noise and columns of one round.
struct Round {
    std::vector<bool> used;
    NoiseBelief noise;
    Eigen::VectorXd sigma_mm;
    bool over_sessions = false;  ///< may the machine have changed between sessions?
};

NoiseBelief belief_of(const Prepared& p, const Eigen::VectorXd& residual_mm,
                      const Eigen::VectorXd& sigma_mm) {
    NoiseModel start;
    start.source = p.base.noise_given ? NoiseSource::given : NoiseSource::assumed;
    NoiseBelief belief;
    belief.model = noise_from_repeats({p.replay, p.table, p.blocks}, residual_mm, sigma_mm, start);
    switch (belief.model.source) {
        case NoiseSource::repeats:
            belief.prior.spread = std::max(0.03, 0.5 * belief.model.doubt);
            break;
        case NoiseSource::given: belief.prior.spread = 0.3; break;
        case NoiseSource::assumed: belief.prior.spread = 0.7; break;
    }
    belief.most = std::exp(2.0 * 2.0 * std::max(0.3, belief.prior.spread));
    return belief;
}

void leave_out(const Prepared& p, const std::vector<std::size_t>& rows, Round& round) {
    for (const std::size_t i : rows) {
        const auto row = static_cast<Eigen::Index>(i);
        round.used[i] = false;
        round.sigma_mm(row) = outlier_sigma * p.base.sigma_mm(row);
    }
}

/// Whitened set-up and data, with an additional row for each calibrated value.
Design empty_design(const Prepared& p, const Whitener& whitener, const std::vector<bool>& used) {
    std::vector<std::size_t> calibrated;
    for (std::size_t j = 0; j < p.base.parameters.size(); ++j)
        if (p.base.parameters[j].prior_sigma > 0.0) calibrated.push_back(j);
    const Eigen::Index n = p.base.residual_mm.size();
    const auto extra = static_cast<Eigen::Index>(calibrated.size());
    Eigen::MatrixXd known = Eigen::MatrixXd::Zero(n + extra, p.base.columns.cols());
    Eigen::VectorXd data(n + extra);
    Eigen::MatrixXd columns = p.base.columns;
    whitener.apply(columns);
    known.topRows(n) = columns;
    data.head(n) = whitener.apply(p.base.residual_mm);
    for (Eigen::Index k = 0; k < extra; ++k) {
        const std::size_t j = calibrated[static_cast<std::size_t>(k)];
        const identification::FitParameter& q = p.base.parameters[j];
        known(n + k, static_cast<Eigen::Index>(j)) = q.typical / q.prior_sigma;
        data(n + k) = (q.prior_value - q.value) / q.prior_sigma;
    }
    const auto rows = static_cast<double>(std::count(used.begin(), used.end(), true) + extra);
    return {std::move(known), std::move(data), rows};
}

Eigen::VectorXd rest_of(const Prepared& p, Design& design, const Model& model) {
    return left_mm(p, design, model, solved(design, model));
}

/// What a model leaves of the readings, and what may hide in it.
KeySearch::Remainder left_by(const Prepared& p, KeySearch& keys, Design& design,
                             const Model& model) {
    return keys.remainder(rest_of(p, design, model), fitted_mm(p, design, model));
}

struct KeyedEffect {
    const effects::Effect* effect;
    std::vector<double> keys;
};

/// The `count` most promising settings of each keyed effect.
std::vector<KeyedEffect> promising(const Prepared& p, KeySearch& keys,
                                   const KeySearch::Remainder& left, int count) {
    std::vector<KeyedEffect> list;
    for (const effects::Effect& effect : p.catalogue) {
        if (!has_keys(effect) || !is_searched(p, effect)) continue;
        for (auto& setting : keys.best(effect, left, count))
            list.push_back({&effect, std::move(setting)});
    }
    return list;
}

/// Adds these settings; of each effect the first, if it is a ripple that the positions do not
/// resolve, as a possible rival, with its keys refined on the residual `rest_mm`.
void add_keyed(Design& design, const Prepared& p, const Whitener& whitener,
               const std::vector<KeyedEffect>& list, const Eigen::VectorXd& rest_mm) {
    const effects::Effect* last = nullptr;
    for (const KeyedEffect& keyed : list) {
        const bool first = std::exchange(last, keyed.effect) != keyed.effect;
        if (add_ripple_or_other(design, p, whitener, *keyed.effect, keyed.keys) || !first) continue;
        add_unresolved_ripple(
            design, p, whitener, *keyed.effect,
            identification::refine_keys(p.replay, p.base, *keyed.effect, keyed.keys, rest_mm));
    }
}

/// A group with the keys of one member refined on the residual of the other causes.
std::optional<std::size_t> refined_group(Design& design, const Prepared& p,
                                         const Whitener& whitener, const Model& model,
                                         std::size_t position) {
    const ColumnGroup group = design.group(model.members[position]);
    const Model rest = without(model, position);
    return add_ripple_or_other(design, p, whitener, *group.effect,
                               identification::refine_keys(p.replay, p.base, *group.effect,
                                                           group.keys, rest_of(p, design, rest)));
}

Model without_drivers(const Design& design, Model model) {
    for (std::size_t k = model.members.size(); k-- > 0;)
        if (design.group(model.members[k]).kind == GroupKind::driver) model = without(model, k);
    return model;
}

/// Refines the keys of members, and grows the model again from there. Drivers are excluded
/// meanwhile, because they would absorb the residual of a wrong key and conceal it. Returns the
/// better model.
Model with_refined_keys(Design& design, const SearchSetting& setting, const Prepared& p,
                        const Whitener& whitener, Model model) {
    Model trial = without_drivers(design, model);
    bool changed = false;
    for (std::size_t k = 0; k < trial.members.size(); ++k) {
        if (design.group(trial.members[k]).kind != GroupKind::periodic) continue;
        const auto better = refined_group(design, p, whitener, trial, k);
        if (!better) continue;
        trial.members[k] = *better;
        changed = true;
    }
    if (!changed) return model;
    trial = grown(design, setting, tuned(design, setting, std::move(trial), 2));
    return trial.score > model.score ? trial : model;
}

/// Adds ripples of an axis in place of its free-form positioning error, which may imitate them.
void add_ripples_instead(Design& design, const Prepared& p, const Whitener& whitener,
                         KeySearch& keys, const Model& model) {
    for (std::size_t k = 0; k < model.members.size(); ++k) {
        const ColumnGroup& group = design.group(model.members[k]);
        if (group.kind != GroupKind::table ||
            group.table.motion != effects::EffectKind::positioning)
            continue;
        const effects::Effect* ripple =
            effects::find_effect(p.catalogue, effects::EffectKind::cyclic, group.table.axis.axis);
        if (!ripple || modelled(p, *ripple)) continue;
        const Model rest = without(model, k);
        std::vector<KeyedEffect> list;
        for (auto& setting : keys.best(*ripple, left_by(p, keys, design, rest), first_keys))
            list.push_back({ripple, std::move(setting)});
        add_keyed(design, p, whitener, list, rest_of(p, design, rest));
    }
}

/// Adds keyed effects in place of a driver, which needs no keys: with rough ones they would lose.
void add_keyed_instead(Design& design, const Prepared& p, const Whitener& whitener, KeySearch& keys,
                       const Model& model) {
    for (std::size_t k = 0; k < model.members.size(); ++k) {
        if (design.group(model.members[k]).kind != GroupKind::driver) continue;
        const Model rest = without(model, k);
        const Eigen::VectorXd rest_mm = rest_of(p, design, rest);
        auto list = promising(p, keys, left_by(p, keys, design, rest), 1);
        for (KeyedEffect& keyed : list)
            keyed.keys = identification::refine_keys(p.replay, p.base, *keyed.effect,
                                                     std::move(keyed.keys), rest_mm);
        add_keyed(design, p, whitener, list, rest_mm);
    }
}

struct Searched {
    Design design;
    SearchSetting setting;
    Model model;
};

/// The members of an earlier round in a new design; searched keys are added again.
Model carried_over(const Searched& earlier, Design& design, const Prepared& p,
                   const Whitener& whitener) {
    Model model{{}, {{}, earlier.model.variances.nu}, 0.0};
    for (std::size_t k = 0; k < earlier.model.members.size(); ++k) {
        const ColumnGroup& group = earlier.design.group(earlier.model.members[k]);
        std::optional<std::size_t> at;
        if (group.kind == GroupKind::periodic)
            at = add_keyed_group(design, p, whitener, *group.effect, group.keys);
        for (std::size_t g = 0; !at && g < design.groups().size(); ++g)
            if (same_cause(design.group(g), group) &&
                design.group(g).parameters == group.parameters &&
                design.group(g).shape.rows() == group.shape.rows() &&
                (group.kind != GroupKind::table ||
                 (design.group(g).shape.cols() == group.shape.cols() &&
                  design.group(g).shape == group.shape)))
                at = g;
        if (!at) continue;
        model.members.push_back(*at);
        model.variances.tau.push_back(earlier.model.variances.tau[k]);
    }
    return model;
}

/// All groups, and the model that the search finds; a later round starts from the earlier model.
Searched search_of(const Prepared& p, const Round& round, KeySearch& keys, const Searched* earlier,
                   const std::function<bool()>& go_on) {
    const Whitener whitener(p.replay, p.blocks, round.noise.model, round.sigma_mm);
    Design design = empty_design(p, whitener, round.used);
    Eigen::Index owned = add_textbook_groups(design, p, whitener);
    if (round.over_sessions) owned += add_change_groups(design, p, whitener);
    add_table_groups(design, p, whitener);
    add_offset_groups(design, p, whitener);
    add_driver_groups(design, p, whitener, owned);
    SearchSetting setting = search_setting(design, round.noise.prior);
    setting.go_on = go_on;
    setting.refine = [&](const Model& m, std::size_t position) {
        return refined_group(design, p, whitener, m, position);
    };
    Model model;
    if (earlier) {
        model = tuned(design, setting, carried_over(*earlier, design, p, whitener), 2);
    } else {
        const auto left = left_by(p, keys, design, empty_model(design, setting));
        add_keyed(design, p, whitener, promising(p, keys, left, first_keys),
                  rest_of(p, design, empty_model(design, setting)));
        model = searched(design, setting);
    }
    for (int pass = 0; pass < 2 && !setting.stopped(); ++pass) {
        const double before = model.score;
        model = with_refined_keys(design, setting, p, whitener, std::move(model));
        add_keyed(design, p, whitener, promising(p, keys, left_by(p, keys, design, model), 1),
                  rest_of(p, design, model));
        add_ripples_instead(design, p, whitener, keys, model);
        add_keyed_instead(design, p, whitener, keys, model);
        model = settled(design, setting, grown(design, setting, std::move(model)));
        if (model.score < before + 1.0) break;
    }
    FoldColumns rows(design, {p.folds, round.used});
    model = without_idle_members(rows, setting, std::move(model));
    add_jumps_instead(design, p, whitener, keys, model);
    setting.refine = {};  // what it refers to ends here
    setting.go_on = {};
    return {std::move(design), std::move(setting), std::move(model)};
}

/// Large effects make the readings nonlinear (the stylus touches the sphere off-axis): replaces the
/// linear prediction of the model by that of the emulator. False when the change was negligible.
/// One setup is used for all sessions here, so changes between them remain linear.
bool straighten(Prepared& p, Searched& s) {
    const Solution solution = without_changes(s.design, s.model, solved(s.design, s.model));
    const setup::Setup setup = setup_with(p, s.design, s.model, solution);
    const std::vector<double> read = p.replay.predict(
        setup.machine, identification::offsets_to(p.replay, setup), effects::active_models(setup));
    const Eigen::Map<const Eigen::VectorXd> bent(read.data(), p.base.measured_mm.size());
    Eigen::VectorXd change = p.base.measured_mm - bent - left_mm(p, s.design, s.model, solution);
    // The emulator reads from the first row of a test, the columns of effects do not: only a zero.
    free_zeros(p.replay, p.base.sigma_mm, change);
    const Eigen::VectorXd straight = p.base.residual_mm + change;
    const auto whitened = [&](const Eigen::VectorXd& v) {
        return v.cwiseQuotient(p.base.sigma_mm).norm();
    };
    // Directions that the readings hardly show may be metres long: no machine is bent like that.
    if (!(whitened(straight) <= most_bent * whitened(p.base.residual_mm))) return false;
    if (change.cwiseQuotient(p.base.sigma_mm).cwiseAbs().maxCoeff() < bend_sigma) return false;
    p.base.residual_mm = straight;
    return true;
}

bool same_noise(const NoiseModel& a, const NoiseModel& b) {
    for (const records::Device device :
         {records::Device::sphere, records::Device::touch, records::Device::ballbar}) {
        const DeviceNoise &x = a.of(device), &y = b.of(device);
        if (std::abs(x.scale - y.scale) > 0.03 * x.scale) return false;
        if (std::abs(x.shared - y.shared) > 0.03) return false;
        if (x.shared > 0.03 && std::abs(x.memory - y.memory) > 0.03) return false;
    }
    return true;
}

/// Applies what the first model reveals about the round: outliers, other noise, nonlinear readings.
/// False: no further search is needed.
bool corrected(Prepared& p, Searched& s, Round& round) {
    const Eigen::VectorXd left = rest_of(p, s.design, s.model);
    bool changed = false;
    const Sizes sizes =
        sizes_of(s.design, s.model, 1.0, std::vector<bool>(s.model.members.size(), false));
    const auto wild = wild_readings(sizes.remainder.head(left.size()), round.used);
    if (!wild.empty()) {
        leave_out(p, wild, round);
        changed = true;
    }
    if (round.noise.model.source == NoiseSource::repeats && (!s.model.members.empty() || changed)) {
        const NoiseBelief noise = belief_of(p, left, round.sigma_mm);
        if (!same_noise(noise.model, round.noise.model)) {
            round.noise = noise;
            changed = true;
        }
    }
    if (!s.model.members.empty() && straighten(p, s)) changed = true;
    return changed;
}

}  // namespace

const char* to_string(Verdict verdict) {
    switch (verdict) {
        case Verdict::no_gap: return "no-gap";
        case Verdict::explained: return "explained";
        case Verdict::partly_explained: return "partly-explained";
        case Verdict::ambiguous: return "ambiguous";
        case Verdict::unexplained: return "unexplained";
    }
    return "";
}

const char* to_string(NoiseSource source) {
    return source == NoiseSource::repeats ? "repeats"
           : source == NoiseSource::given ? "given"
                                          : "assumed";
}

Diagnosis diagnose(const setup::Setup& setup, const records::ReadingTable& table,
                   const DiagnosisOptions& options) {
    if (options.over_sessions)
        if (const auto named = files_as_sessions(table)) return diagnose(setup, *named, options);
    if (const auto fewer = thinned(table, most_readings)) {
        Diagnosis d = diagnose(setup, *fewer, options);
        d.chosen_from = static_cast<std::size_t>(std::count_if(
            table.rows.begin(), table.rows.end(),
            [](const records::Reading& row) { return row.device != records::Device::none; }));
        return d;
    }
    const auto watch = [&](const char* stage) {
        if (options.watch) options.watch(stage);
    };
    Prepared p = prepare(setup, table);
    if (options.holdout) refuse_poor_holdout(p, *options.holdout);
    if (options.over_sessions) refuse_one_session(p);
    const std::vector<bool> all(p.replay.size(), true);
    Round round{all, {}, p.base.sigma_mm, options.over_sessions};
    round.noise = belief_of(p, p.base.residual_mm, round.sigma_mm);
    leave_out(p, lone_probe_readings(p, round.used), round);
    take_promising_sides(p);
    std::optional<KeySearch> keys(std::in_place, p.replay, p.base);
    watch("search among models");
    Searched s = search_of(p, round, *keys, nullptr, options.go_on);
    const auto stopped = [&] { return options.go_on && !options.go_on(); };
    for (int k = 1; k < most_rounds && !stopped(); ++k) {
        const bool turned = retake_sides(p, s.design, s.model);
        if (turned) keys.emplace(p.replay, p.base);  // its columns were computed for other sides
        if (!corrected(p, s, round) && !turned) break;
        s = search_of(p, round, *keys, &s, options.go_on);
    }
    const bool unfinished = stopped();
    if (unfinished) s.model = computable(s.design, s.setting, std::move(s.model));
    watch("held-out readings");
    s.setting.go_on = options.go_on;
    FoldColumns rows(s.design, {p.folds, round.used});
    const Challenged found = unfinished ? unchallenged(std::move(s.model))
                                        : challenged(rows, s.setting, std::move(s.model));
    s.setting.go_on = {};
    const Judgement judgement = judged(rows, p, found.model, round.noise);
    Diagnosis d = report_of(
        {p, s.design, s.setting, found.model, judgement, round.noise, round.used, found}, options);
    d.unfinished = found.ended;  // else only the next measurement may be missing
    if (const auto gap = store_gap(setup, table)) add_store_gap(setup, *gap, options.holdout, d);
    return d;
}

}  // namespace trunnion::diagnosis

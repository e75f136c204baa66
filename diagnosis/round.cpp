#include "diagnosis/round.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/units.h"
#include "diagnosis/alike_periods.h"
#include "diagnosis/changes.h"
#include "diagnosis/groups/candidate_groups.h"
#include "diagnosis/groups/machine_jump.h"
#include "diagnosis/groups/rests.h"
#include "diagnosis/groups/ripples.h"
#include "diagnosis/prepare/both_sides.h"
#include "diagnosis/prepare/near_readings.h"
#include "diagnosis/refined_keys.h"
#include "diagnosis/rules/rules.h"
#include "diagnosis/search/solution.h"
#include "diagnosis/search/whole_drivers.h"
#include "effects/settings.h"
#include "estimation/quantiles.h"
#include "identification/identify.h"

namespace trunnion::diagnosis {
namespace {

constexpr double outlier_sigma = 1e3;  ///< sigma of an excluded reading, relative to its own
constexpr int first_keys = 2;
/// Of readings without noise, in sigma: less than this is arithmetic, and beside it no fit is
/// determined.
constexpr double least_noise = 1e-6;

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

struct KeyedEffect {
    const effects::Effect* effect;
    std::vector<double> keys;
};

/// Step of the actual positions of a log, in mm or in degrees; 0 without one, endless where no axis
/// of this kind is logged.
double step_of_log(const Prepared& p, bool angular) {
    std::vector<double> spread;
    for (std::size_t i = 0; i < p.replay.size(); ++i)
        if (p.replay.contact(i).device == records::Device::axis &&
            p.table.rows[p.replay.table_row(i)].angular == angular)
            spread.push_back(p.rounding_mm(static_cast<Eigen::Index>(i)));
    if (spread.empty()) return HUGE_VAL;
    const double step = std::sqrt(12.0) * estimation::median(std::move(spread));
    return angular ? deg_from_rad(step) : step;
}

/// True for a control that rounds as finely as the log itself: the same columns, and no cause.
bool is_step_of_log(const Prepared& p, const effects::Effect& effect,
                    const std::vector<double>& keys) {
    constexpr double alike = 2.0;
    if (effect.kind != effects::EffectKind::control_rounding ||
        p.replay.contact(0).device != records::Device::axis)
        return false;
    for (std::size_t j = 0; j < keys.size(); ++j)
        if (effect.parameters[j].is_key() &&
            keys[j] > alike * step_of_log(p, effect.parameters[j].name == "increment_deg"))
            return false;
    return true;
}

/// The `count` most promising settings of each keyed effect.
std::vector<KeyedEffect> promising(const Prepared& p, KeySearch& keys,
                                   const KeySearch::Remainder& left, int count) {
    std::vector<KeyedEffect> list;
    for (const effects::Effect& effect : p.catalogue) {
        if (!has_keys(effect) || !is_searched(p, effect)) continue;
        for (auto& setting : keys.best(effect, left, count))
            if (!is_step_of_log(p, effect, setting)) list.push_back({&effect, std::move(setting)});
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
        const auto sharp =
            first ? period_at_few_places(p, *keyed.effect, keyed.keys, rest_mm) : std::nullopt;
        const std::vector<double>& keys = sharp ? *sharp : keyed.keys;
        if (add_ripple_or_other(design, p, whitener, *keyed.effect, keys) || !first) continue;
        add_unresolved_ripple(
            design, p, whitener, *keyed.effect,
            sharp ? keys
                  : identification::refine_keys(p.replay, p.base, *keyed.effect, keys, rest_mm));
    }
}

/// Adds ripples of an axis in place of its free-form positioning error, which may imitate them,
/// alone and together with its scale.
void add_ripples_instead(Design& design, const Prepared& p, const Whitener& whitener, Rests& rests,
                         const Model& model) {
    for (std::size_t k = 0; k < model.members.size(); ++k) {
        const ColumnGroup& group = design.group(model.members[k]);
        if (group.kind != GroupKind::table ||
            group.table.motion != effects::EffectKind::positioning)
            continue;
        const effects::Effect* ripple =
            effects::find_effect(p.catalogue, effects::EffectKind::cyclic, group.table.axis.axis);
        if (!ripple || modelled(p, *ripple)) continue;
        const auto is_line = [&](std::size_t m) {
            const ColumnGroup& other = design.group(m);
            return other.kind == GroupKind::textbook && other.effect->axis == ripple->axis &&
                   other.effect->kind == effects::EffectKind::scale;
        };
        Model rest_of_axis = without(model, k);
        for (bool both = false;; both = true) {
            const Rests::Rest rest = rests.of(rest_of_axis);
            std::vector<KeyedEffect> list;
            for (auto& setting : rests.keys().best(*ripple, rest.remainder, first_keys))
                list.push_back({ripple, std::move(setting)});
            add_keyed(design, p, whitener, list, rest.mm);
            const auto line =
                std::find_if(rest_of_axis.members.begin(), rest_of_axis.members.end(), is_line);
            if (both || line == rest_of_axis.members.end()) break;
            rest_of_axis = without(rest_of_axis,
                                   static_cast<std::size_t>(line - rest_of_axis.members.begin()));
        }
    }
}

/// Adds keyed effects in place of a driver, which needs no keys: with rough ones they would lose.
void add_keyed_instead(Design& design, const Prepared& p, const Whitener& whitener, Rests& rests,
                       const Model& model) {
    for (std::size_t k = 0; k < model.members.size(); ++k) {
        if (design.group(model.members[k]).kind != GroupKind::driver) continue;
        const Rests::Rest rest = rests.of(without(model, k));
        auto list = promising(p, rests.keys(), rest.remainder, 1);
        for (KeyedEffect& keyed : list)
            keyed.keys = identification::refine_keys(p.replay, p.base, *keyed.effect,
                                                     std::move(keyed.keys), rest.mm);
        add_keyed(design, p, whitener, list, rest.mm);
    }
}

/// Where a play along the travel was found: the model with keyed effects in place of all free forms
/// of positions and plays, if it is better. A spike at the reversals beside a lag or a play looks
/// like several of these, and its keys, sought beside them, are those of what they leave.
Model with_keys_for_plays(const KeyedDesign& keyed, const SearchSetting& setting, Rests& rests,
                          Model model) {
    const auto& [design, p, whitener] = keyed;
    if (std::none_of(model.members.begin(), model.members.end(),
                     [&](std::size_t m) { return design.group(m).table.play != nullptr; }))
        return model;
    Model trial = tuned(design, setting, without_forms_along(design, model), 2);
    const identification::KeyGain gain = gain_beside(keyed, trial);
    for (const KeyedEffect& found : promising(p, rests.keys(), rests.of(trial).remainder, 1))
        add_ripple_or_other(design, p, whitener, *found.effect,
                            best_keys(gain, *found.effect, found.keys));
    trial = with_refined_keys(keyed, setting, grown(design, setting, std::move(trial)));
    return trial.score > model.score ? trial : model;
}

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
            if (same_cause(design.group(g), group) && design.group(g).is_whole == group.is_whole &&
                design.group(g).parameters == group.parameters &&
                design.group(g).shape.rows() == group.shape.rows() &&
                (group.kind != GroupKind::table ||
                 (design.group(g).table.directions == group.table.directions &&
                  design.group(g).shape.cols() == group.shape.cols() &&
                  design.group(g).shape == group.shape)))
                at = g;
        if (!at) continue;
        model.members.push_back(*at);
        model.variances.tau.push_back(earlier.model.variances.tau[k]);
    }
    return model;
}

/// Nobody knows how far the assumed noise is from the true one, but neighbours do: that is what is
/// expected, and beyond twice their doubt it is no noise. Readings of a simulation have none at
/// all: two deviations of the assumption are the least.
void take_neighbours(const NeighbourNoise& told, NoiseBelief& belief) {
    if (told.variance <= 0.0) return;
    const double off = std::max(0.5 * std::log(told.variance), -2.0 * belief.prior.spread);
    belief.most = std::max(belief.most, told.variance * (1.0 + 2.0 * told.doubt));
    if (std::abs(off) > belief.prior.spread) belief.prior.log_mean = off;
}

/// Both sides of a line tell the noise itself, not what it is at most.
bool take_sides(const NeighbourNoise& told, NoiseBelief& belief) {
    if (told.variance <= 0.0) return false;
    belief.prior.log_mean = 0.5 * std::log(told.variance);
    belief.prior.spread = std::max(0.3, 0.5 * told.doubt);
    belief.most = told.variance * std::exp(6.0 * belief.prior.spread);  // three deviations
    return true;
}

}  // namespace

Eigen::VectorXd rest_of(const Prepared& p, Design& design, const Model& model) {
    return left_mm(p, design, model, solved(design, model));
}

NoiseBelief belief_of(const Prepared& p, const Eigen::VectorXd& residual_mm, const Round& round) {
    NoiseModel start;
    start.source = p.base.noise_given ? NoiseSource::given : NoiseSource::assumed;
    NoiseBelief belief;
    const RepeatedRows rows{p.replay, p.table, p.blocks, round.used, p.cycle, p.rounding_mm};
    belief.model = noise_from_repeats(rows, residual_mm, round.sigma_mm, start);
    // What is stated is the noise of a reading; repeats have that of their stops as well.
    DeviceNoise& point = belief.model.point;
    point.shared = round.shared_by_stops;
    point.turned = round.turned_by_stops;
    if (belief.model.source != NoiseSource::repeats)
        point.scale /= std::sqrt(1.0 - point.shared - point.turned);
    // The errors of rounding may be somewhat smaller than those of even numbers.
    belief.prior.least =
        std::max(least_noise, 0.7 * least_by_rounding(rows, round.sigma_mm, belief.model));
    switch (belief.model.source) {
        case NoiseSource::repeats:
            belief.prior.spread = std::max(0.03, 0.5 * belief.model.doubt);
            break;
        case NoiseSource::given: belief.prior.spread = 0.3; break;
        case NoiseSource::assumed: belief.prior.spread = 0.7; break;
    }
    // What repeats tell is known better than what a data sheet states.
    const double least_doubt = belief.model.source == NoiseSource::repeats ? 0.15 : 0.3;
    belief.most = std::exp(2.0 * 2.0 * std::max(least_doubt, belief.prior.spread));
    // With what was found to add, too, noise is at most a few times what is stated.
    const double more = p.base.sigma_mm.squaredNorm() / p.stated_sigma_mm.squaredNorm();
    belief.most *= std::min(1.0, rules::most_scatter * rules::most_scatter / more);
    if (belief.model.source != NoiseSource::assumed) return belief;
    const Eigen::VectorXd white = residual_mm.cwiseQuotient(round.sigma_mm);
    if (!take_sides(noise_of_sides(rows, white, belief.prior.least), belief))
        take_neighbours(noise_of_neighbours(p.replay, round.used, residual_mm, round.sigma_mm),
                        belief);
    return belief;
}

void pass_over(const Prepared& p, const std::vector<std::size_t>& rows, Round& round) {
    for (const std::size_t i : rows) {
        const auto row = static_cast<Eigen::Index>(i);
        round.sigma_mm(row) = outlier_sigma * p.base.sigma_mm(row);
    }
}

void leave_out(const Prepared& p, const std::vector<std::size_t>& rows, Round& round) {
    pass_over(p, rows, round);
    for (const std::size_t i : rows) round.used[i] = false;
}

Searched search_of(const Prepared& p, const Round& round, KeySearch& keys, const Searched* earlier,
                   const std::function<bool()>& go_on) {
    const Whitener whitener(p.replay, p.blocks, round.noise.model, round.sigma_mm);
    Design design = empty_design(p, whitener, round.used);
    Eigen::Index owned = add_textbook_groups(design, p, whitener);
    take_radius_for_stretch(design);
    if (round.over_sessions) owned += add_change_groups(design, p, whitener);
    add_table_groups(design, p, whitener);
    add_offset_groups(design, p, whitener);
    add_driver_groups(design, p, whitener, owned);
    add_wandering_groups(design, p, whitener, owned);
    take_line_for_positioning(design, p);
    SearchSetting setting = search_setting(design, round.noise.prior);
    setting.go_on = go_on;
    setting.refine = [&](const Model& m, std::size_t position) {
        return refined_group({design, p, whitener}, m, position);
    };
    Rests rests(p, design, keys);
    Model model;
    if (earlier) {
        model = tuned(design, setting, carried_over(*earlier, design, p, whitener), 2);
    } else {
        const Rests::Rest rest = rests.of(empty_model(design, setting));
        add_keyed(design, p, whitener, promising(p, keys, rest.remainder, first_keys), rest.mm);
        model = searched(design, setting);
    }
    for (int pass = 0; pass < 2 && !setting.stopped(); ++pass) {
        const double before = model.score;
        model = with_refined_keys({design, p, whitener}, setting, std::move(model));
        if (pass == 0)
            model = with_keys_for_plays({design, p, whitener}, setting, rests, std::move(model));
        const Rests::Rest rest = rests.of(model);
        add_keyed(design, p, whitener, promising(p, keys, rest.remainder, 1), rest.mm);
        add_ripples_instead(design, p, whitener, rests, model);
        add_keyed_instead(design, p, whitener, rests, model);
        model = settled(design, setting, grown(design, setting, std::move(model)));
        if (model.score < before + 1.0) break;
    }
    if (!setting.stopped())
        model =
            without_open_ripples({p, whitener, design, setting, round.sigma_mm}, std::move(model));
    model = with_whole_drivers(design, setting, std::move(model));
    FoldColumns rows(design, {p.folds, round.used});
    model = without_idle_members(rows, setting, std::move(model));
    add_jumps_instead(design, p, whitener, rests, model);
    add_unnamed_forms(design, p, whitener);
    take_line_for_positioning(design, p);
    add_spoiled_visits(design, p, round.used);
    setting.refine = {};  // what it refers to ends here
    setting.go_on = {};
    return {std::move(design), std::move(setting), std::move(model)};
}

}  // namespace trunnion::diagnosis

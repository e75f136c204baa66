#include "identification/identify.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/alarm.h"
#include "effects/settings.h"
#include "estimation/quantiles.h"
#include "identification/index_errors.h"
#include "identification/key_settings.h"
#include "identification/keys.h"
#include "identification/needed_terms.h"
#include "identification/set_up_words.h"
#include "identification/start_pose.h"
#include "identification/unknown_sides.h"
#include "identification/unknowns.h"

namespace trunnion::identification {
namespace {

bool keyed(const effects::Effect& effect) {
    return std::any_of(effect.parameters.begin(), effect.parameters.end(),
                       [](const effects::EffectParameter& p) { return p.is_key(); });
}

/// Bounds for the search of a key: the next grid values on both sides that differ by more than 3 %.
std::pair<double, double> neighbours(const std::vector<double>& grid, double value) {
    double low = grid.front() * 0.7, high = grid.back() * 1.4;
    for (const double g : grid) {
        if (g < 0.97 * value) low = g;
        if (g > 1.03 * value) high = std::min(high, g);
    }
    return {low, high};
}

double rms_of(const Eigen::VectorXd& v) {
    return std::sqrt(v.squaredNorm() / static_cast<double>(std::max<Eigen::Index>(1, v.size())));
}

}  // namespace

namespace {

/// A time between two readings has the same effect anywhere between them: take the middle of that
/// interval.
double middle_of_plateau(const std::function<double(double)>& gain_at, double key,
                         std::pair<double, double> bracket) {
    const double best = gain_at(key), tiny = 1e-6 * (bracket.second - bracket.first);
    if (gain_at(key - tiny) != best && gain_at(key + tiny) != best) return key;
    const auto edge = [&](double beyond) {
        double level = key, off = beyond;
        if (gain_at(off) == best) return off;
        for (int k = 0; k < 24; ++k) {
            const double middle = 0.5 * (level + off);
            (gain_at(middle) == best ? level : off) = middle;
        }
        return level;
    };
    return 0.5 * (edge(bracket.first) + edge(bracket.second));
}

/// Turns by which the phase of a ripple differs over the travel between two periods; 0 for other
/// keys. What a ripple explains has a peak for every turn.
double turns_between(const emulator::Replay& replay, const effects::Effect& effect,
                     std::pair<double, double> periods) {
    if (effect.kind != effects::EffectKind::cyclic) return 0.0;
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (std::size_t i = 0; i < replay.size(); ++i) {
        low = std::min(low, replay.sample(i).position[*effect.axis]);
        high = std::max(high, replay.sample(i).position[*effect.axis]);
    }
    return (high - low) * (1.0 / periods.first - 1.0 / periods.second);
}

/// The part of a bracket around the highest of several peaks: golden section climbs any of them.
std::pair<double, double> around_highest_peak(const std::function<double(double)>& gain_at,
                                              std::pair<double, double> bracket, double turns) {
    constexpr double steps_per_turn = 3.0, most_steps = 120.0;
    if (turns < 1.0) return bracket;
    const auto count = static_cast<int>(std::min(most_steps, std::ceil(steps_per_turn * turns)));
    const auto [low, high] = bracket;
    const double step = (high - low) / count;
    int best = 0;
    double most = -1.0;
    for (int k = 0; k <= count; ++k)
        if (const double gain = gain_at(low + k * step); gain > most) {
            most = gain;
            best = k;
        }
    return {std::max(low, low + (best - 1) * step), std::min(high, low + (best + 1) * step)};
}

}  // namespace

std::vector<double> refine_keys(const KeyGain& gain, const effects::Effect& effect,
                                std::vector<double> keys) {
    constexpr double golden = 0.6180339887498949;
    double best = gain(effect, keys);
    for (std::size_t j = 0; j < keys.size(); ++j) {
        const effects::EffectParameter& p = effect.parameters[j];
        if (!p.is_key() || !p.refine) continue;
        const auto at = [&](double value) {
            std::vector<double> trial = keys;
            trial[j] = value;
            return gain(effect, trial);
        };
        for (int round = 0; round < 4; ++round) {
            const auto [from, to] = neighbours(p.grid, keys[j]);
            auto [low, high] = around_highest_peak(
                at, {from, to}, turns_between(gain.replay(), effect, {from, to}));
            double a = high - golden * (high - low), b = low + golden * (high - low);
            double fa = at(a), fb = at(b);
            for (int step = 0; step < 14; ++step) {
                if (fa > fb) {
                    high = b;
                    b = a;
                    fb = fa;
                    fa = at(a = high - golden * (high - low));
                } else {
                    low = a;
                    a = b;
                    fa = fb;
                    fb = at(b = low + golden * (high - low));
                }
            }
            if (std::max(fa, fb) <= best) break;
            best = std::max(fa, fb);
            keys[j] = fa > fb ? a : b;
            // The optimum at an end of the bracket lies beyond it: search again from there.
            const double edge = 0.02 * (to - from);
            if (keys[j] > from + edge && keys[j] < to - edge) break;
        }
        keys[j] = middle_of_plateau(at, keys[j], neighbours(p.grid, keys[j]));
    }
    return keys;
}

std::vector<double> refine_keys(const emulator::Replay& replay, const BaseModel& base,
                                const effects::Effect& effect, std::vector<double> keys,
                                const Eigen::VectorXd& left_mm) {
    return refine_keys(KeyGain(replay, base, left_mm), effect, std::move(keys));
}

std::vector<double> search_keys(const emulator::Replay& replay, const BaseModel& base,
                                const effects::Effect& effect, const Eigen::VectorXd& left_mm) {
    const KeyGain gain(replay, base, left_mm);
    std::vector<double> best = effect.zeros();
    double most = -1.0;
    for (const std::vector<double>& values : key_settings(effect, best))
        if (const double g = gain(effect, values); g > most) {
            most = g;
            best = values;
        }
    return refine_keys(gain, effect, best);
}

namespace {

/// The keyed effects of a fit.
std::vector<const effects::Effect*> keyed_effects(const effects::Catalogue& catalogue,
                                                  const std::vector<std::string>& effects) {
    std::vector<const effects::Effect*> list;
    for (const effects::Effect& effect : catalogue)
        if (keyed(effect) &&
            std::find(effects.begin(), effects.end(), effect.name) != effects.end())
            list.push_back(&effect);
    return list;
}

/// Each keyed effect at the keys that explain most beside those found before it; fewer when `go_on`
/// ends the search.
std::vector<KeyedEffect> search_all_keys(const emulator::Replay& replay, const BaseModel& base,
                                         const std::vector<const effects::Effect*>& effects,
                                         const std::function<bool()>& go_on) {
    std::vector<KeyedEffect> list;
    BaseModel grown = base;
    for (const effects::Effect* each : effects) {
        if (go_on && !go_on()) break;
        const effects::Effect& effect = *each;
        KeyedEffect entry{&effect, search_keys(replay, grown, effect, base.residual_mm), {}};
        for (std::size_t j = 0; j < effect.parameters.size(); ++j) {
            const effects::EffectParameter& p = effect.parameters[j];
            if (p.is_key()) {
                if (p.refine) entry.free.push_back(j);
                continue;
            }
            grown.columns.conservativeResize(Eigen::NoChange, grown.columns.cols() + 1);
            grown.columns.col(grown.columns.cols() - 1) =
                effect_column(replay, base.gradient, {effect, entry.values, j});
        }
        list.push_back(std::move(entry));
    }
    return list;
}

/// Enters the fitted amplitudes.
void take_values(const BaseModel& base, std::vector<KeyedEffect>& effects) {
    for (KeyedEffect& e : effects)
        for (std::size_t j = 0; j < e.values.size(); ++j)
            for (const FitParameter& f : base.parameters)
                if (f.effect == e.effect->name && f.name == e.effect->parameters[j].name &&
                    f.component == e.effect->parameters[j].component)
                    e.values[j] = f.value;
}

/// The keys of the effects, at the values of the catalogue; their sigma is not known yet.
void add_keys(const effects::Catalogue& catalogue, const std::vector<std::string>& effects,
              std::vector<FitParameter>& parameters) {
    for (const std::string& name : effects)
        for (const effects::EffectParameter& p : effects::find_effect(catalogue, name)->parameters)
            if (p.is_key())
                parameters.push_back(
                    {name, p.name, p.unit, -1, p.typical, p.typical, std::nan(""), 0.0, 0.0});
}

/// Typical residual relative to the noise: about 1 where nothing is missing in the fit. A few
/// readings that are far off do not count.
double misfit_of(const BaseModel& base, int dof) {
    const Eigen::VectorXd size = base.residual_mm.cwiseQuotient(base.sigma_mm);
    const double typical = estimation::robust_deviation({size.data(), size.data() + size.size()});
    return typical * std::sqrt(static_cast<double>(size.size()) / std::max(1, dof));
}

/// Where nobody states the noise, the residual is what is known of it: the uncertainties follow.
/// Beside a stated noise a large residual shows that the fit lacks something.
void take_misfit(const BaseModel& base, Identification& result) {
    constexpr double worth_a_note = 2.0;
    const double misfit = misfit_of(base, result.dof);
    if (!base.noise_given && misfit > 1.0) {
        for (FitParameter& p : result.parameters) p.sigma *= misfit;
        result.covariance *= misfit * misfit;
    }
    if (misfit < worth_a_note) return;
    result.notes.push_back(
        base.noise_given
            ? fmt::format("the residual is {:.0f} times the stated noise: something is missing in "
                          "this fit, and its values are less certain than their sigma says "
                          "(trunnion diagnose looks for it)",
                          misfit)
            : fmt::format("the residual is {:.0f} times the noise assumed of these readings, and "
                          "nobody states it: sigma is multiplied by it",
                          misfit));
}

/// The effects of a fit: those asked for, else those of the setup, and the index of a telescope.
std::vector<std::string> fitted_effects(const setup::Setup& setup,
                                        std::vector<std::string> effects) {
    if (effects.empty()) effects = setup.model.modelled;
    if (const std::string index = index_effect(setup);
        std::find(setup.model.modelled.begin(), setup.model.modelled.end(), index) !=
            setup.model.modelled.end() &&
        std::find(effects.begin(), effects.end(), index) == effects.end())
        effects.push_back(index);
    return effects;
}

/// Sizes of the residual; throws InputError where nothing is left to tell the uncertainty.
void describe_fit(const records::ReadingTable& table, const BaseModel& base,
                  Identification& result) {
    const double micro = records::micro_per_one(table);
    result.rms_before_um = micro * rms_of(base.start_residual_mm);
    result.rms_after_um = micro * rms_of(base.residual_mm);
    result.dof = static_cast<int>(base.residual_mm.size()) - base.rank;
    if (result.dof < 1)
        throw InputError(
            fmt::format("{} readings are too few to determine {} unknowns and their uncertainty",
                        base.residual_mm.size(), base.rank),
            {table.path, 0, 0});
    result.set_up_words = set_up_words(base.setup, base.parameters);
    for (std::string& sentence : index_words(base.setup))
        result.set_up_words.push_back(std::move(sentence));
}

}  // namespace

Identification identify(const setup::Setup& given, const records::ReadingTable& table,
                        std::vector<std::string> effects, const std::function<bool()>& go_on) {
    const setup::Setup setup = with_start_poses(with_index_errors(given, table), table);
    effects = fitted_effects(setup, std::move(effects));
    emulator::Replay replay(setup, table);
    if (replay.size() < 2)
        throw InputError("fewer than two readings with a device", {table.path, 0, 0});
    effects::Catalogue catalogue = effects::make_catalogue(setup, effects::extent_of(setup, table));
    std::vector<std::string> plain;
    for (const std::string& name : effects) {
        const effects::Effect* effect = effects::find_effect(catalogue, name);
        if (!effect) effects::refuse_effect_name(setup, name);
        if (!keyed(*effect)) plain.push_back(name);
    }
    std::vector<std::string> notes;
    for (const FoundSide& found : choose_sides(setup, table, replay, catalogue, plain))
        notes.push_back(table.path + ": " + to_string(found));
    std::vector<KeyedEffect> with_keys;
    std::vector<std::string> not_searched;
    if (plain.size() < effects.size()) {
        BaseModel base = fit_base(setup, table, replay, catalogue, plain);
        need_gradient(base, replay);
        const std::vector<const effects::Effect*> searched = keyed_effects(catalogue, effects);
        with_keys = search_all_keys(replay, base, searched, go_on);
        for (std::size_t k = with_keys.size(); k < searched.size(); ++k)
            not_searched.push_back(searched[k]->name);
        if (!go_on || go_on()) refine_together(replay, base, with_keys);
        for (const KeyedEffect& e : with_keys) {
            effects::Effect& effect =
                catalogue[static_cast<std::size_t>(e.effect - catalogue.data())];
            for (std::size_t j = 0; j < e.values.size(); ++j)
                if (effect.parameters[j].is_key()) effect.parameters[j].typical = e.values[j];
        }
    }
    BaseModel base = fit_needed_terms({setup, table, replay, effects}, catalogue, notes);
    Identification result;
    result.parameters = base.parameters;
    add_keys(catalogue, effects, result.parameters);
    take_values(base, with_keys);
    if (!with_keys.empty()) need_gradient(base, replay);
    add_key_uncertainty(replay, with_keys, base, result.parameters);
    result.inseparable = base.inseparable;
    result.covariance = base.covariance;
    result.angles = records::only_angles(table);
    describe_fit(table, base, result);
    result.not_searched = std::move(not_searched);
    result.notes = std::move(notes);
    result.notes.insert(result.notes.end(), base.notes.begin(), base.notes.end());
    take_misfit(base, result);
    result.setup = std::move(base.setup);
    return result;
}

}  // namespace trunnion::identification

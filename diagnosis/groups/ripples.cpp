#include "diagnosis/groups/ripples.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/units.h"
#include "diagnosis/prepare/places.h"
#include "diagnosis/rules/rules.h"
#include "identification/identify.h"
#include "identification/key_gain.h"

namespace trunnion::diagnosis {
namespace {

constexpr std::size_t least_places = 8;
constexpr double least_turns = 2.0, most_hole = 0.4, least_spacings = 2.0, least_outside = 0.2;
/// Of a spike: one that does not decay on the way between two readings is a backlash.
constexpr double least_other = 0.01;
/// Two ripples are alike that part by less over all positions (assumed).
constexpr double same_cycles = 0.1;
/// Keys with the same values that are listed. A step of 20 m reaches it; a wild coordinate of
/// 1e9 mm would have some 1e9 of them.
constexpr std::size_t most_aliases = 10'000;

/// Greatest length that divides both; what is below `zero` counts as none.
double common_divisor(double a, double b, double zero) {
    while (b > zero) {
        double rest = std::fmod(a, b);
        if (b - rest < zero) rest = 0.0;
        a = std::exchange(b, rest);
    }
    return a;
}

/// Step of a grid that contains all positions, possibly with empty nodes; 0 if there is none. On
/// it, periods below two steps are aliases of longer ones: targets at whole degrees, 4 to 6 apart,
/// see 356 periods in a turn as 4.
double grid_step(const std::vector<double>& places) {
    constexpr double least_part = 2e-3;  // of the least distance: a finer grid is none
    constexpr double off_grid = 1e-2;    // of the step
    std::vector<double> distances;
    for (std::size_t k = 1; k < places.size(); ++k) distances.push_back(places[k] - places[k - 1]);
    if (distances.empty()) return 0.0;
    const double zero = least_part * *std::min_element(distances.begin(), distances.end());
    double step = 0.0;
    for (const double d : distances) step = common_divisor(d, step, zero);
    const double range = places.back() - places.front();
    step = range / std::round(range / step);
    const auto misses = [&](double d) {
        return std::abs(std::remainder(d, step)) > off_grid * step;
    };
    return std::any_of(distances.begin(), distances.end(), misses) ? 0.0 : step;
}

/// True for a period of exactly two steps: the readings alternate, and show it at two phases.
bool alternates(double step, double period) {
    return step > 0.0 && std::abs(period - 2.0 * step) < 1e-3 * step;
}

double largest_hole(const std::vector<double>& places, double period) {
    std::vector<double> phase;
    for (const double q : places) phase.push_back(q / period - std::floor(q / period));
    std::sort(phase.begin(), phase.end());
    double hole = 1.0 - phase.back() + phase.front();
    for (std::size_t k = 1; k < phase.size(); ++k) hole = std::max(hole, phase[k] - phase[k - 1]);
    return hole;
}

/// Axis, key and period of a ripple; empty for other effects with keys.
struct Ripple {
    Axis axis;
    std::size_t key;              ///< index of the parameter
    bool counts;                  ///< periods in a turn, else the period itself
    double period;                ///< mm or rad
    std::vector<double> offered;  ///< keys that the catalogue offers
    double period_of(double value) const { return counts ? 2.0 * pi / value : value; }
};
std::optional<Ripple> ripple_of(const effects::Effect& effect, const std::vector<double>& keys) {
    if (effect.kind != effects::EffectKind::cyclic) return std::nullopt;
    for (std::size_t j = 0; j < keys.size(); ++j) {
        const effects::EffectParameter& key = effect.parameters[j];
        if (!key.is_key()) continue;
        Ripple ripple{*effect.axis, j, key.counts_periods, 0.0, key.grid};
        ripple.period = ripple.period_of(keys[j]);
        return ripple;
    }
    return std::nullopt;
}

std::vector<double> distinct(std::vector<double> places) {
    std::sort(places.begin(), places.end());
    if (places.empty()) return places;
    const double same = 1e-6 * (places.back() - places.front());
    places.erase(std::unique(places.begin(), places.end(),
                             [&](double a, double b) { return b - a <= same; }),
                 places.end());
    return places;
}

/// Positions at which readings tell the error of an axis.
std::vector<double> places_for(const Prepared& prepared, Axis axis) {
    return positions_at(telling_places(prepared, axis));
}

double frequency_on_grid(double step, double period) {
    return std::abs(std::remainder(step / period, 1.0));
}

/// Keys of the catalogue with the same values as the ripple on a grid of this step, longest period
/// first: any period m / step +- 1 / period, or a number of periods in a turn. `range`: from
/// the first position to the last, mm or rad as the step.
std::vector<double> aliases_on(double step, double range, const Ripple& ripple) {
    std::vector<double> list;
    const auto [least, most] = std::minmax_element(ripple.offered.begin(), ripple.offered.end());
    const double own = frequency_on_grid(step, ripple.period);
    if (ripple.counts) {
        // Angles rounded to 0.001 deg have a fine grid: in one of its steps all ripples are alike.
        const double same = same_cycles * step / range;
        for (double count = std::ceil(*least); count <= *most; ++count)
            if (std::abs(frequency_on_grid(step, 2.0 * pi / count) - own) < same)
                list.push_back(count);
    } else {
        for (double cycles = 0.0; step / (cycles + 0.5) >= *least && list.size() < most_aliases;
             ++cycles)
            for (const double f : {cycles - own, cycles + own})
                if (f > 0.0 && step / f >= *least && step / f <= *most) list.push_back(step / f);
    }
    return list;
}

/// Step of the grid of all positions of an axis; 0 without one.
double step_of(const std::vector<double>& places) {
    return places.empty() ? 0.0 : grid_step(places);
}

/// The key with the longest period among those that the positions cannot tell apart.
void take_longest_period(const std::vector<double>& places, const Ripple& ripple,
                         std::vector<double>& keys) {
    const double step = step_of(places);
    if (step == 0.0 || ripple.period >= least_spacings * step) return;
    for (const double alias : aliases_on(step, places.back() - places.front(), ripple))
        if (ripple.period_of(alias) > ripple.period_of(keys[ripple.key])) keys[ripple.key] = alias;
}

/// Features of the textbook effects of the same axis.
std::vector<Eigen::Index> of_axis(const Design& design, const effects::Effect& effect) {
    std::vector<Eigen::Index> features;
    for (const auto& entry : design.groups())
        if (entry.group.kind == GroupKind::textbook && entry.group.effect->axis == effect.axis)
            features.insert(features.end(), entry.group.features.begin(),
                            entry.group.features.end());
    std::sort(features.begin(), features.end());
    features.erase(std::unique(features.begin(), features.end()), features.end());
    return features;
}

/// True when a ripple is no alias of textbook effects: a fifth of it is outside their columns, or
/// what is outside is so much, at its usual size, that they would not count as its rivals.
bool separable(const Design& design, std::size_t group, const std::vector<Eigen::Index>& others) {
    const double part = design.outside(group, others);
    return part >= least_outside || part * design.groups()[group].gram.trace() >= rules::rival_loss;
}

/// Other keys of a ripple with the same values at all positions.
std::vector<double> other_periods(const Prepared& prepared, const Ripple& ripple,
                                  const std::vector<double>& keys) {
    const std::vector<double> places = places_for(prepared, ripple.axis);
    const double step = step_of(places);
    if (step == 0.0) return {};
    std::vector<double> list = aliases_on(step, places.back() - places.front(), ripple);
    const double own = keys[ripple.key];
    std::erase_if(list, [&](double key) { return std::abs(key - own) < 1e-2 * own; });
    return list;
}

}  // namespace

bool shows_period(std::vector<double> places, double period) {
    places = distinct(std::move(places));
    if (places.size() < least_places) return false;
    if (places.back() - places.front() < least_turns * period) return false;
    // A full step of a motor: every second position is off, and they are many.
    if (alternates(grid_step(places), period) && places.size() >= many_on_grid) return true;
    if (largest_hole(places, period) > most_hole) return false;
    return period >= least_spacings * grid_step(places);
}

bool may_be_usual(const effects::Effect& effect, const std::vector<double>& keys,
                  const std::vector<double>& others) {
    constexpr double near = 1e-3, least_mm = 2.0, steps_mm[] = {0.5, 25.4 / 8.0};
    const auto ripple = ripple_of(effect, keys);
    if (!ripple || ripple->counts) return true;
    std::vector<double> periods = others;
    periods.push_back(ripple->period);
    return std::any_of(periods.begin(), periods.end(), [&](double period) {
        return std::any_of(std::begin(steps_mm), std::end(steps_mm), [&](double step_mm) {
            return period >= least_mm * (1.0 - near) &&
                   std::abs(std::remainder(period, step_mm)) < near * period;
        });
    });
}

std::vector<double> equal_periods(const Prepared& prepared, const effects::Effect& effect,
                                  const std::vector<double>& keys) {
    const auto ripple = ripple_of(effect, keys);
    if (!ripple) return {};
    std::vector<double> list = other_periods(prepared, *ripple, keys);
    std::erase_if(list,
                  [&](double key) { return ripple->period_of(key) < far_finer * ripple->period; });
    return list;
}

bool shows_two_phases(const Prepared& prepared, const effects::Effect& effect,
                      const std::vector<double>& keys) {
    const auto ripple = ripple_of(effect, keys);
    return ripple && alternates(step_of(places_for(prepared, ripple->axis)), ripple->period);
}

std::size_t place_count(const Prepared& prepared, Axis axis) {
    std::vector<double> places;
    for (std::size_t i = 0; i < prepared.replay.size(); ++i)
        places.push_back(prepared.replay.sample(i).position[axis]);
    return distinct(std::move(places)).size();
}

double chance_of_period(const Prepared& prepared, const effects::Effect& effect,
                        const std::vector<double>& keys, double part) {
    const auto ripple = ripple_of(effect, keys);
    if (!ripple) return 0.0;
    const std::vector<double> places = places_for(prepared, ripple->axis);
    const auto count = static_cast<double>(places.size());
    const double free = 0.5 * (count - 3.0);  // mean, cosine and sine are fitted
    if (free <= 0.0) return 1.0;
    const auto [least, most] = std::minmax_element(ripple->offered.begin(), ripple->offered.end());
    const double range = places.back() - places.front(), step = step_of(places);
    // Between two periods that are independent of each other the best one fits better.
    constexpr double between = 3.0;
    double periods = ripple->counts ? *most : between * range / *least;
    if (step > 0.0) periods = std::min(periods, 0.5 * (range / step + 1.0));
    return std::min(1.0, periods * std::pow(1.0 - part, free));
}

std::optional<std::vector<double>> period_at_few_places(const Prepared& prepared,
                                                        const effects::Effect& effect,
                                                        std::vector<double> keys,
                                                        const Eigen::VectorXd& rest_mm) {
    constexpr double steps_per_cycle = 16.0;    // from end to end of the range
    constexpr std::size_t most_readings = 500;  // more of them are seldom at few places
    constexpr double short_mm = 200.0;  // beyond, periods are too many (ripple_periods_mm())
    const auto ripple = ripple_of(effect, keys);
    if (!ripple || ripple->counts || prepared.replay.size() > most_readings) return std::nullopt;
    const std::vector<double> places = places_for(prepared, ripple->axis);
    if (places.size() < least_places || places.size() >= many_on_grid ||
        places.back() - places.front() >= short_mm)
        return std::nullopt;
    const identification::KeyGain gain(prepared.replay, prepared.base, rest_mm);
    const auto [least, most] = std::minmax_element(ripple->offered.begin(), ripple->offered.end());
    const double step = 1.0 / (steps_per_cycle * (places.back() - places.front()));
    double best = gain(effect, keys);
    for (double frequency = 1.0 / *most; frequency <= 1.0 / *least; frequency += step) {
        std::vector<double> trial = keys;
        trial[ripple->key] = 1.0 / frequency;
        if (const double value = gain(effect, trial); value > best) {
            best = value;
            keys = std::move(trial);
        }
    }
    return identification::refine_keys(prepared.replay, prepared.base, effect, std::move(keys),
                                       rest_mm);
}

void add_unresolved_ripple(Design& design, const Prepared& prepared, const Whitener& whitener,
                           const effects::Effect& effect, std::vector<double> keys) {
    const auto ripple = ripple_of(effect, keys);
    if (!ripple || places_for(prepared, ripple->axis).size() < least_places) return;
    const bool usual = may_be_usual(effect, keys, other_periods(prepared, *ripple, keys));
    const double odd = usual ? 0.0 : rules::odd_period_prior;
    const auto added = add_keyed_group(design, prepared, whitener, effect, std::move(keys));
    if (!added) return;
    design.favour(*added, odd);
    design.keep_as_rival(*added);
}

std::optional<std::size_t> add_ripple_or_other(Design& design, const Prepared& prepared,
                                               const Whitener& whitener,
                                               const effects::Effect& effect,
                                               std::vector<double> keys) {
    auto ripple = ripple_of(effect, keys);
    if (ripple) {
        const std::vector<double> places = places_for(prepared, ripple->axis);
        take_longest_period(places, *ripple, keys);
        ripple->period = ripple->period_of(keys[ripple->key]);
        const bool unique = other_periods(prepared, *ripple, keys).empty();
        if (!shows_period(places, ripple->period_of(keys[ripple->key])) ||
            (!unique && places.size() < many_on_grid))
            return std::nullopt;
    }
    const auto added = add_keyed_group(design, prepared, whitener, effect, std::move(keys));
    if (!added || !effect.axis) return added;
    const std::vector<Eigen::Index> others = of_axis(design, effect);
    if (ripple ? separable(design, *added, others) : design.outside(*added, others) >= least_other)
        return added;
    design.hide(*added);
    return std::nullopt;
}

}  // namespace trunnion::diagnosis

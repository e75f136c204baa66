#include "diagnosis/ripples.h"

#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "diagnosis/key_search.h"

namespace trunnion::diagnosis {
namespace {

constexpr std::size_t least_places = 8;
constexpr double least_turns = 2.0, most_hole = 0.4, least_spacings = 2.0, least_outside = 0.2;

/// Step of a grid that contains all positions, possibly with empty nodes; 0 if there is none. On
/// it, periods below two steps are aliases of longer ones.
double grid_step(const std::vector<double>& places) {
    double step = places.back() - places.front();
    for (std::size_t k = 1; k < places.size(); ++k)
        step = std::min(step, places[k] - places[k - 1]);
    for (std::size_t k = 1; k < places.size(); ++k)
        if (std::abs(std::remainder(places[k] - places[k - 1], step)) > 1e-3 * step) return 0.0;
    return step;
}

double largest_hole(const std::vector<double>& places, double period) {
    std::vector<double> phase;
    for (const double q : places) phase.push_back(q / period - std::floor(q / period));
    std::sort(phase.begin(), phase.end());
    double hole = 1.0 - phase.back() + phase.front();
    for (std::size_t k = 1; k < phase.size(); ++k) hole = std::max(hole, phase[k] - phase[k - 1]);
    return hole;
}

/// Axis and period of a ripple; empty for other effects with keys.
struct Ripple {
    Axis axis;
    double period;
    double shortest;  ///< period that the catalogue offers
};
std::optional<Ripple> ripple_of(const effects::Effect& effect, const std::vector<double>& keys) {
    if (effect.kind != effects::EffectKind::cyclic) return std::nullopt;
    for (std::size_t j = 0; j < keys.size(); ++j) {
        const effects::EffectParameter& key = effect.parameters[j];
        if (!key.is_key()) continue;
        const auto [least, most] = std::minmax_element(key.grid.begin(), key.grid.end());
        if (key.name == periods_key)
            return Ripple{*effect.axis, 2.0 * pi / keys[j], 2.0 * pi / *most};
        return Ripple{*effect.axis, keys[j], *least};
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

std::vector<double> positions_of(const Prepared& prepared, Axis axis) {
    std::vector<double> places;
    for (std::size_t i = 0; i < prepared.replay.size(); ++i)
        places.push_back(prepared.replay.sample(i).position[axis]);
    return places;
}

/// True when the positions stand on a grid on which a shorter period of the catalogue has the same
/// values: its frequency is 1 / step - 1 / period.
bool has_alias(std::vector<double> places, const Ripple& ripple) {
    places = distinct(std::move(places));
    if (places.size() < 2) return false;
    const double step = grid_step(places);
    return step > 0.0 && 1.0 / step - 1.0 / ripple.period < 1.0 / ripple.shortest;
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

}  // namespace

bool shows_period(std::vector<double> places, double period) {
    places = distinct(std::move(places));
    if (places.size() < least_places) return false;
    if (places.back() - places.front() < least_turns * period) return false;
    if (largest_hole(places, period) > most_hole) return false;
    return period >= least_spacings * grid_step(places);
}

void add_unresolved_ripple(Design& design, const Prepared& prepared, const Whitener& whitener,
                           const effects::Effect& effect, std::vector<double> keys) {
    const auto ripple = ripple_of(effect, keys);
    if (!ripple || distinct(positions_of(prepared, ripple->axis)).size() < least_places) return;
    const auto added = add_keyed_group(design, prepared, whitener, effect, std::move(keys));
    if (added) design.keep_as_rival(*added);
}

std::optional<std::size_t> add_ripple_or_other(Design& design, const Prepared& prepared,
                                               const Whitener& whitener,
                                               const effects::Effect& effect,
                                               std::vector<double> keys) {
    const auto ripple = ripple_of(effect, keys);
    if (ripple) {
        const std::vector<double> places = positions_of(prepared, ripple->axis);
        if (!shows_period(places, ripple->period) || has_alias(places, *ripple))
            return std::nullopt;
    }
    const auto added = add_keyed_group(design, prepared, whitener, effect, std::move(keys));
    if (added && ripple && design.outside(*added, of_axis(design, effect)) < least_outside) {
        design.hide(*added);
        return std::nullopt;
    }
    return added;
}

}  // namespace trunnion::diagnosis

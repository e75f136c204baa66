// Keys of effects (period, decay, time constant), refined beside what else a model holds.
#pragma once

#include <optional>

#include "diagnosis/prepare/prepare.h"
#include "diagnosis/search/search.h"
#include "identification/key_gain.h"

namespace trunnion::diagnosis {

/// A design that takes further groups, and what their columns come from.
struct KeyedDesign {
    Design& design;
    const Prepared& prepared;
    const Whitener& whitener;
};

/// What keys gain beside the members of a model: columns of known forms are fitted with them, and
/// take no part of what a wrong key leaves. It must not outlive the prepared readings.
identification::KeyGain gain_beside(const KeyedDesign& keyed, const Model& model);

/// Refined keys. Each law of a decay has its own length: those that come near the best one on the
/// grid are refined, too.
std::vector<double> best_keys(const identification::KeyGain& gain, const effects::Effect& effect,
                              const std::vector<double>& keys);

/// Adds a group with the keys of one member refined beside the other causes, with the law that it
/// has; empty where the readings do not show it.
std::optional<std::size_t> refined_group(const KeyedDesign& keyed, const Model& model,
                                         std::size_t position);

/// The model with the best keys of its members, one after the other, and tuned.
Model with_new_keys(const KeyedDesign& keyed, const SearchSetting& setting, Model model);

/// Refines the keys of members, and grows the model again from there. Drivers are excluded
/// meanwhile, because they would absorb the residual of a wrong key and conceal it; so are, in a
/// second trial, free forms of its axis. Returns the best model.
Model with_refined_keys(const KeyedDesign& keyed, const SearchSetting& setting, Model model);

/// The model without drivers and without free forms of positions and plays.
Model without_forms_along(const Design& design, Model model);

}  // namespace trunnion::diagnosis

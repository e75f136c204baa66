// All groups of columns that may explain the gap: catalogue effects, free forms, zeros, drivers.
#pragma once

#include <functional>
#include <optional>

#include "diagnosis/design.h"
#include "diagnosis/prepare.h"

namespace trunnion::diagnosis {

/// Simpler forms of an effect, each a choice of its linear parameters: a straightness without
/// slope, single vectors where an effect has several (one artefact of many), the location of one
/// axis.
std::vector<std::function<bool(const effects::EffectParameter&)>> simpler_forms(
    const effects::Effect& effect);

/// Catalogue effects without keys, in all forms; features first in the design. Returns how many
/// features: what the textbook owns.
Eigen::Index add_textbook_groups(Design& design, const Prepared& prepared,
                                 const Whitener& whitener);

/// Effects without keys, location errors and all else that the simulation has, as changes that
/// begin with the second session or a later one and stay. To be called next after the textbook's;
/// returns how many features.
Eigen::Index add_change_groups(Design& design, const Prepared& prepared, const Whitener& whitener);

/// One group for an effect at one setting of its keys; nothing where no reading moves.
std::optional<std::size_t> add_keyed_group(Design& design, const Prepared& prepared,
                                           const Whitener& whitener, const effects::Effect& effect,
                                           std::vector<double> keys);

/// Error motions of every axis in free form, one group for each correlation length.
void add_table_groups(Design& design, const Prepared& prepared, const Whitener& whitener);

/// Zero of each test: a shift of the work for probes, an offset of the reading for others.
void add_offset_groups(Design& design, const Prepared& prepared, const Whitener& whitener);

/// Drivers beside all that the textbook owns, and as they are for saying where the gap lies.
void add_driver_groups(Design& design, const Prepared& prepared, const Whitener& whitener,
                       Eigen::Index owned);

}  // namespace trunnion::diagnosis

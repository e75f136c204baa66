// The catalogue of all effects of a machine, shared by run, identify and diagnose.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "effects/effect.h"
#include "effects/models.h"

namespace trunnion::effects {

using Catalogue = std::vector<Effect>;

/// All effects of formats.md for this machine and its artefacts, one for each axis concerned.
Catalogue make_catalogue(const setup::Setup& setup, const DataExtent& extent = {});
/// Time span and positions of a table of readings.
DataExtent extent_of(const setup::Setup& setup, const records::ReadingTable& table);

/// Null when the machine has none.
const Effect* find_effect(const Catalogue& catalogue, const std::string& name);
const Effect* find_effect(const Catalogue& catalogue, EffectKind kind, Axis axis);

/// The catalogue as a Markdown table (docs/effects.md).
std::string describe_catalogue(const Catalogue& catalogue);

}  // namespace trunnion::effects

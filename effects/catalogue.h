// All effects that a machine may have: the one list that running, identifying and diagnosing share.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "effects/effect.h"
#include "effects/models.h"

namespace trunnion::effects {

using Catalogue = std::vector<Effect>;

/// Every effect of formats.md for this machine and its artefacts, one for each axis it concerns.
Catalogue make_catalogue(const setup::Setup& setup, const DataExtent& extent = {});
/// Spans of a table of readings.
DataExtent extent_of(const setup::Setup& setup, const records::ReadingTable& table);

const Effect* find_effect(const Catalogue& catalogue, const std::string& name);

/// The catalogue as a Markdown table (docs/effects.md).
std::string describe_catalogue(const Catalogue& catalogue);

}  // namespace trunnion::effects

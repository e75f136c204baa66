// Names of the effects of a catalogue.
#pragma once

#include <string>
#include <vector>

#include "effects/catalogue.h"

namespace trunnion::effects {

/// In the catalogue's order.
std::vector<std::string> names_of(const Catalogue& catalogue);

}  // namespace trunnion::effects

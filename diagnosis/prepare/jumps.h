// Jumps of the machine at the times at which an artefact may have moved: offered as rivals.
#pragma once

#include "effects/catalogue.h"

namespace trunnion::diagnosis {

/// Name of the rival in reports.
inline constexpr const char* machine_jump = "machine.jump";

/// The spindle side, and everything that is read with it, displaced in M from the time of a move of
/// an artefact on (a collision, a lost count, a cup that slipped). It has the parameters of that
/// move, so that both are as probable beforehand. Only readings of another artefact after that
/// time, or with the table turned, see them differently. Empty without such a move.
effects::Catalogue jumps_like_moves(const effects::Catalogue& catalogue);

}  // namespace trunnion::diagnosis

// A jump of the machine: a rival of an artefact's move and of a drift, of which no setup knows.
#pragma once

#include "diagnosis/noise.h"
#include "diagnosis/prepare.h"
#include "diagnosis/rests.h"
#include "effects/catalogue.h"

namespace trunnion::diagnosis {

/// Name of the rival in reports.
inline constexpr const char* machine_jump = "machine.jump";

/// The spindle side, and everything that is read with it, displaced in M from the time of a move of
/// an artefact on (a collision, a lost count, a cup that slipped). It has the parameters of that
/// move, so that both are as probable beforehand. Only readings of another artefact after that
/// time, or with the table turned, see them differently. Empty without such a move.
effects::Catalogue jumps_like_moves(const effects::Catalogue& catalogue);

/// Adds, as a rival, the jump that does most in place of a drift in the model, its time refined:
/// both are courses of time.
void add_jumps_instead(Design& design, const Prepared& prepared, const Whitener& whitener,
                       Rests& rests, const Model& model);

}  // namespace trunnion::diagnosis

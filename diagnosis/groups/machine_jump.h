// A jump of the machine: a rival of an artefact's move and of a drift, of which no setup knows.
#pragma once

#include "diagnosis/groups/rests.h"
#include "diagnosis/prepare/noise.h"
#include "diagnosis/prepare/prepare.h"

namespace trunnion::diagnosis {

/// Adds, as a rival, the jump that does most in place of a drift in the model, its time refined:
/// both are courses of time.
void add_jumps_instead(Design& design, const Prepared& prepared, const Whitener& whitener,
                       Rests& rests, const Model& model);

}  // namespace trunnion::diagnosis

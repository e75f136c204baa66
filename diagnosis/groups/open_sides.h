// Sides from which axes arrived before their first motion, where the table does not give them.
#pragma once

#include "diagnosis/prepare/prepare.h"
#include "diagnosis/search/search.h"

namespace trunnion::diagnosis {

/// Before the search: sets unknown sides to those that fit best with the effects depending on them,
/// the most promising effect first, as long as one explains much beside those already taken.
/// Otherwise + is kept.
void take_promising_sides(Prepared& prepared);

/// Sets unknown sides to those that fit best with all causes of a model. True when one changed; the
/// columns of the effects must then be computed again.
bool retake_sides(Prepared& prepared, const Design& design, const Model& model);

}  // namespace trunnion::diagnosis

// Sides from which axes came before their first motion, where the table leaves them open.
#pragma once

#include "diagnosis/prepare.h"
#include "diagnosis/search.h"

namespace trunnion::diagnosis {

/// Before the search: open sides as those effects fit best that they change, the most promising
/// first, as long as one explains much beside those taken; + where none does.
void take_promising_sides(Prepared& prepared);

/// Open sides as the causes of a model fit best together. True when one is another than before:
/// columns of effects are those of other sides then.
bool retake_sides(Prepared& prepared, const Design& design, const Model& model);

}  // namespace trunnion::diagnosis

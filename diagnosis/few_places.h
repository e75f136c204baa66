// Textbook forms that are read at so few places that they say nothing between them.
#pragma once

#include "diagnosis/prepare.h"
#include "diagnosis/search.h"

namespace trunnion::diagnosis {

/// True for a textbook form with a bend, or with a table beside it, of a linear axis that was read
/// at so few places that other forms would do the same there; and for harmonics of a rotary axis
/// with a gap between its places.
bool bends_at_few_places(const Design& design, const Prepared& prepared, const Model& model,
                         std::size_t position);

}  // namespace trunnion::diagnosis

// The path beside the contour from one move to the next: corners, start-up, cancel.
#pragma once

#include "cutter/beside_path.h"

namespace trunnion::cutter {

/// Completes `first` now that `second` is known. PS0033, PS0038, PS0041.
void finish_first(BesidePath& path, const PathMove& first, const PathMove& second);

}  // namespace trunnion::cutter

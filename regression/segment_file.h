// The segments of a path on disk, and a window on them.
#pragma once

#include "regression/segment.h"
#include "regression/spilled_array.h"

namespace trunnion::regression {

using SegmentFile = SpilledArray<Segment>;
using SegmentWindow = SpilledWindow<Segment>;

}  // namespace trunnion::regression

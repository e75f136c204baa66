// Passes over the targets of an axis: directions that no column tells, and order.
#pragma once

#include "imports/iso_points.h"

namespace trunnion::imports {

/// A turn beyond 360 degrees goes on: 350, 0, 10 are 350, 360, 370. Targets in rad.
void unwrap_turns(std::vector<IsoPoint>& points);
/// Directions that no column tells follow from the order of the targets: where it turns, a target
/// that stands twice as often as in passing is the end of one pass and the begin of the next.
/// Throws InputError (row) where that leaves a side open.
void follow_order(const TextTable& table, std::vector<IsoPoint>& points);
/// Throws InputError unless the targets of each pass rise or fall as its direction says.
void check_order(const TextTable& table, const std::vector<IsoPoint>& points);

}  // namespace trunnion::imports

// Passes over the targets of an axis: directions without a column, and order.
#pragma once

#include "imports/iso_points.h"

namespace trunnion::imports {

/// Continues a rotation beyond 360 degrees: 350, 0, 10 become 350, 360, 370. Targets in rad.
void unwrap_turns(std::vector<IsoPoint>& points);
/// Directions without a column follow from the order of the targets: at a reversal, a target with
/// twice the readings of a passed one is the end of one pass and the start of the next; a step back
/// over other targets starts another pass in the same direction, and so does each run of a column.
/// `way`: direction told for all passes, or 0. Throws InputError (row) when a side remains
/// undetermined.
void follow_order(const TextTable& table, std::vector<IsoPoint>& points, int way);
/// Reverses passes that are listed against their direction, and leaves the times in their order.
/// Returns true if there was one.
bool turn_passes(std::vector<IsoPoint>& points);
/// Throws InputError unless the targets of each pass rise or fall according to its direction.
void check_order(const TextTable& table, const std::vector<IsoPoint>& points);

}  // namespace trunnion::imports

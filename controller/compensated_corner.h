// The way beside the contour from one move to the next: corners, start-up, cancel.
#pragma once

#include "controller/path_queue.h"
#include "base/alarm.h"

namespace trunnion {

/// An alarm without a place gets that of the block the move stands in.
void place_alarm(Alarm& alarm, const BlockMarks& marks);

/// Points at the cutter's offset square to the end or start of a move.
PlanePoint square_to_end(const PathMove& m);
PlanePoint square_to_start(const PathMove& m);

/// The compensated point in the plane.
PlanePoint tool_in_plane(const ControlState& c);
/// A straight way to `end` with the feed of `m`.
void line_to(ControlState& c, const PathMove& m, PlanePoint end);
/// The move itself beside its path, from where the tool stands to `end`. PS0034, PS0038, PS0041.
void run_beside(ControlState& c, const PathMove& m, PlanePoint end);
/// `first` is finished now that `second` is known. PS0033, PS0038, PS0041.
void finish_first(ControlState& c, const PathMove& first, const PathMove& second);

}  // namespace trunnion

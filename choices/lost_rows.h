// Places where a log leaves one move in its middle and goes on in another: rows were lost there.
#pragma once

#include "choices/judged_log.h"

namespace trunnion::choices {

/// The log with such places marked as cut, if this control's moves between them are not in the log
/// and nothing else shows it (no times, no jump far longer than every other distance); nothing if
/// there is none, or too many for lost rows. A control ends its moves: where the samples break off
/// more than two of their distances before the end of a motion, and begin as far behind the begin
/// of another, no other control has left out the moves between; nor has one where the samples do
/// only one of these, but a feed is lost wholly. (A drill that turns too early goes on with a
/// rapid.) Every row is judged as before.
std::optional<LogOfProgram> with_lost_rows(LogOfProgram log, const ComparedRun& run);

/// Most of the period of the samples of a log, minutes: by the distances of rows on moves at a feed
/// (the third largest over its feed, so that the feed of the other control may be a lower one in
/// most places). 0: the log has too few of them.
double minutes_of_samples(const LogView& view, const ComparedRun& run);

/// Takes that reading of a log before any cause is sought, if it leaves no gap.
void settle_lost_rows(const Asked& asked, LogOfProgram& log);

}  // namespace trunnion::choices

// Block numbers that a control logs some rows late or early: seen in the log alone.
#pragma once

#include <optional>

#include "choices/pairing.h"

namespace trunnion::choices {

/// Rows by which the numbers are behind the positions; negative: ahead of them.
struct Lateness {
    int least = 0, most = 0;
};

/// Most changes of the number stand a few rows beside a corner of the way, always on the same side.
/// Neither the program nor the control is asked, so no store and no choice can look like it.
/// Nothing where corners are too few or disagree.
std::optional<Lateness> lateness_of(const LogView& log);

/// The log with its numbers moved. Rows around the changes have none, because the lateness is not
/// known to the row: their positions tell.
LogView without_lateness(const LogView& log, const Lateness& late);

}  // namespace trunnion::choices

// Logs of samples that have a row at every end of a motion: seen in the log alone.
#pragma once

#include "choices/pairing.h"

namespace trunnion::choices {

/// Almost every corner between two straight ways of the log is one of its rows, exactly: no sample
/// at equal times would do so. False where there are too few corners.
bool has_rows_at_ends(const LogView& log);

}  // namespace trunnion::choices

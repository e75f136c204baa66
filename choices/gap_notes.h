// Notes on what a log cannot show.
#pragma once

#include <string>
#include <vector>

#include "choices/compared_run.h"

namespace trunnion::choices {

/// Moves of the path come after the last row.
bool ends_before(const ComparedRun& base);

/// A note if the log begins after the program, or ends before it.
void tell_rest(const LogView& log, const ComparedRun& base, std::vector<std::string>& notes);

/// What the samples cannot show; a log with a row at every end of a move shows it.
void tell_sampling(const LogView& log, std::vector<std::string>& notes);

}  // namespace trunnion::choices

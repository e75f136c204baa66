// What the block numbers of a log mean where they do not fit as they are read: late, from 0, or of
// a part of the program.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "choices/compared_run.h"
#include "choices/log_view.h"

namespace trunnion::choices {

struct LogSource {
    const records::PositionLog& log;
    const std::vector<interpreter::ProgramText>& texts;  ///< the main program first
    /// A control compared with a log.
    std::function<ComparedRun(const LogOfProgram&)> run;
};

/// Nothing beyond noise: mean and largest distance, or as large ones as a noise has by chance that
/// is stated, or known from some rows.
bool is_quiet(const LogOfProgram& log, const ComparedRun& run);

/// Another start of the control: not the first row of a log of samples.
LogOfProgram from_machine_zero(LogOfProgram log);

/// What comes before the first row is not judged.
LogOfProgram begun_within(LogOfProgram log);

/// Blocks with motion before the first row. A trace has only ends of moves: that it lacks the first
/// ones may be the other control's way.
bool lacks_begin(const LogOfProgram& log, const ComparedRun& run);

/// Rows assigned by their order alone.
LogOfProgram without_numbers(LogOfProgram log);

/// Replaces the log by another reading of it only where that removes (almost) all of a gap, or, for
/// late numbers, where the corners of the log itself show it; a note tells.
void settle_meaning(const LogSource& source, LogOfProgram& log);

/// The log without its numbers of blocks, if three blocks or more are wrong by these and all
/// positions agree in their order. That is no gap, unless a choice of the control explains the
/// numbers, too: it moves the same way in other blocks (5006#6).
std::optional<LogOfProgram> agreeing_in_order(const LogSource& source, LogOfProgram log);

/// The same for late numbers alone; false: the log stays as it is.
bool settle_lateness(const LogSource& source, LogOfProgram& log);

}  // namespace trunnion::choices

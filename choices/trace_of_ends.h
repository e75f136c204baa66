// A log without a column `motion` whose rows are ends of moves, not samples.
#pragma once

#include "choices/compared_run.h"
#include "choices/log_view.h"

namespace trunnion::choices {

/// `log` is read as ends of moves, `run` the control compared with it. Its rows are ends if there
/// are few more of them than moves, and most keep to the ends of moves, or to the same difference
/// from them as the row before. Samples do so only where the axes rest.
bool seems_trace(const LogOfProgram& log, const ComparedRun& run);

/// As many rows as the path has moves, within a half.
bool may_be_trace(const records::PositionLog& log, const ControlPath& path);

/// The same log, each row the end of a move.
records::PositionLog as_trace(records::PositionLog log);

}  // namespace trunnion::choices

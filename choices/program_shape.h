// Does a log have the shape of a program at all? Asked of straight ways, wherever they are.
#pragma once

#include "choices/judged_log.h"

namespace trunnion::choices {

/// A log of samples without numbers, of linear axes, whose straight ways go where no move of the
/// program goes. No store of a three-axis program turns a move (but common variables, with which
/// nothing is said), and no option of the table makes clearly more of them fit: a search would take
/// minutes for nothing. False where the log is short, or has too few straight ways.
bool fits_nowhere(const Asked& asked, const LogOfProgram& log);

}  // namespace trunnion::choices

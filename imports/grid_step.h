// Least increment of logged positions, from their values: a control may count coarser than its log
// prints.
#pragma once

#include "records/position_log.h"

namespace trunnion::imports {

/// The step, mm, of which all linear coordinates of samples are whole multiples apart, within
/// `printed`, their printed increment. 0 where the values show none that is coarser.
double grid_step(const records::PositionLog& log, double printed_mm);

}  // namespace trunnion::imports

// Variables that show positions: #5001 to #5140 and the vector of G54.2 from #5500.
#pragma once

#include <optional>

#include "controller/skip.h"

namespace trunnion::controller {

/// #5001.. block end, #5021.. machine, #5041.. work, #5061.. skip, #5081.. tool length, #5101..
/// servo deviation, #5121.. movement by the handle (both always 0 here); #5500 the number of G54.2
/// and #5501.. its vector. Lengths in the unit in force, angles in deg. Nothing for another number.
std::optional<double> position_variable(int number, const Modal& modal, const Frames& frames,
                                        const SkipState& skip);

}  // namespace trunnion::controller

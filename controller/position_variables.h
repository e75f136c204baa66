// Variables of positions: #5001 to #5140, and the vector of G54.2 from #5500.
#pragma once

#include <optional>

#include "controller/skip.h"

namespace trunnion::controller {

/// #5001.. block end, #5021.. machine, #5041.. work, #5061.. skip, #5081.. tool length, #5101..
/// servo deviation, #5121.. handle displacement (the last two are always 0); #5500 the number of
/// G54.2 and #5501.. its vector. #100001, #100051 .. #100251: the same from the block end to the
/// servo deviation, for up to 50 axes (30i and 0i-F; the skip position: 15i-MA programming p. 564,
/// the others from memory). Lengths in the active unit, angles in deg. Empty for any other number.
std::optional<double> position_variable(int number, const Modal& modal, const Frames& frames,
                                        const SkipState& skip);

}  // namespace trunnion::controller

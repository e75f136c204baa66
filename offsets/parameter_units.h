// Parameters that are lengths in machine units: inches on an inch machine (1001#0 INM = 1).
#pragma once

#include "offsets/stores.h"

namespace trunnion::offsets {

/// mm in one unit of this parameter as it is typed at the control (a setup's number, G10 L52 R):
/// 25.4 for 19666, 19700-19705 and 19709-19714 of an inch machine (A-79348E p. 84), else 1. The
/// store holds mm. What G20 or 0000#2 say about programs is another matter.
double parameter_unit_mm(const Parameters& parameters, int number);

}  // namespace trunnion::offsets

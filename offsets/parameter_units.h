// Parameters that are lengths in machine units: inch on an inch machine (1001#0 INM = 1).
#pragma once

#include "offsets/stores.h"

namespace trunnion::offsets {

/// Size in mm of one unit of this parameter as typed at the control (a number in the setup file,
/// G10 L52 R): 25.4 for 19666, 19700-19705 and 19709-19714 of an inch machine (A-79348E p. 84),
/// else 1. The store contains mm. G20 and 0000#2 concern program units only.
double parameter_unit_mm(const Parameters& parameters, int number);

}  // namespace trunnion::offsets

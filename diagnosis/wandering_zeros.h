// Zeros of cycles that wander beside the causes (wandering_zeros.cpp).
#pragma once

#include "diagnosis/diagnosis_report.h"

namespace trunnion::diagnosis {

/// Adds the zeros of a laser's cycles to the places of the gap, where they are as large as the
/// noise and the list lacks them: they are free beside the causes, so no cause and no held-out
/// reading shows that the machine or its instrument moves from cycle to cycle.
void add_wandering_zeros(const Outcome& found, std::vector<DriverShare>& where);

}  // namespace trunnion::diagnosis

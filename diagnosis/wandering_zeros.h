// Zeros of cycles that wander beside the causes, and what times would tell (wandering_zeros.cpp).
#pragma once

#include "diagnosis/diagnosis_report.h"

namespace trunnion::diagnosis {

/// Adds to the places of the gap the zeros of a laser's cycles, where they are as large as the
/// noise and a twentieth of the gap, or large, and the list lacks them: they are free beside the
/// causes, so no cause and no held-out reading shows that the machine or its instrument moves from
/// cycle to cycle. A note says so where such a change could be a drift, but the table has no times.
void tell_wandering_zeros(const Outcome& found, Diagnosis& d);

}  // namespace trunnion::diagnosis

// Forms that the last digit of the readings makes (rounded_forms.cpp).
#pragma once

#include <vector>

#include "diagnosis/diagnosis_report.h"

namespace trunnion::diagnosis {

/// A scale that shows steps coarser than the noise shows the same step again in every cycle: the
/// errors of rounding are a curve of the position, which left-out readings of the same places
/// confirm. A table or a ripple no larger than these errors is as likely nothing but them.
void doubt_rounded_forms(const Outcome& found, std::vector<Claim>& claims);

}  // namespace trunnion::diagnosis

// Nuisances of a diagnosis: poses, zeros and gains, which are never causes.
#pragma once

#include "diagnosis/diagnosis_report.h"
#include "diagnosis/search/solution.h"

namespace trunnion::diagnosis {

/// The set-up as it is written, with the uncertainty that causes and noise leave; in words, poses
/// of instruments and zeros of encoders.
void describe_set_up(const Outcome& found, const Solution& solution, Diagnosis& d);

}  // namespace trunnion::diagnosis

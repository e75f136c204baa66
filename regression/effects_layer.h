// The layer `effects`: what a program leaves behind.
#pragma once

#include "regression/comparison.h"
#include "regression/recorded_run.h"

namespace trunnion {

/// Variables, offsets, parameters, printed lines, alarms and cycle time; adds a difference for
/// each.
void compare_effects(const RecordedRun& a, const RecordedRun& b, const Tolerances& tolerances,
                     Comparison& result);

/// Cycle times beyond the tolerance; part of the layers `axes` and `effects`.
void compare_times(const RecordedRun& a, const RecordedRun& b, const Tolerances& tolerances,
                   Comparison& result);

}  // namespace trunnion

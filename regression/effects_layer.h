// The layer `effects`: what a program leaves behind.
#pragma once

#include "regression/comparison.h"
#include "regression/recorded_run.h"

namespace trunnion::regression {

/// Variables, offsets, parameters, printed lines, alarms and cycle time; adds a difference for
/// each.
void compare_effects(const RecordedRun& a, const RecordedRun& b, const Tolerances& tolerances,
                     Comparison& result);

/// The same without the cycle time, and #100-#199 only where both sides hold a value: one side's
/// counter of a loop is no result; offsets and parameters only with `stores`. Part of the layer
/// `functions`.
void compare_leftovers(const RecordedRun& a, const RecordedRun& b, bool stores,
                       const Tolerances& tolerances, Comparison& result);

/// Cycle times beyond the tolerance; part of the layers `axes` and `effects`.
void compare_times(const RecordedRun& a, const RecordedRun& b, const Tolerances& tolerances,
                   Comparison& result);

}  // namespace trunnion::regression

// The layer `effects`: the state that a program leaves.
#pragma once

#include "regression/comparison.h"
#include "regression/recorded_run.h"

namespace trunnion::regression {

/// Compares variables, offsets, parameters, printed lines, alarms and cycle time; adds a difference
/// for each.
void compare_effects(const RecordedRun& a, const RecordedRun& b, const Tolerances& tolerances,
                     Comparison& result);

/// The same without the cycle time. #100-#199 are compared only if both sides have a value, because
/// a loop counter of one side is no result. Offsets and parameters only with `stores`. Part of the
/// layer `functions`.
void compare_leftovers(const RecordedRun& a, const RecordedRun& b, bool stores,
                       const Tolerances& tolerances, Comparison& result);

/// Compares cycle times with the tolerance; part of the layers `axes` and `effects`.
void compare_times(const RecordedRun& a, const RecordedRun& b, const Tolerances& tolerances,
                   Comparison& result);

}  // namespace trunnion::regression

// The layer `functions`: compares functions, their order and their positions on the path.
#pragma once

#include "regression/comparison.h"
#include "regression/describe.h"
#include "regression/recorded_run.h"

namespace trunnion::regression {

/// A run and the source it is shown with.
struct FunctionSide {
    const RecordedRun& run;
    SourceLines& lines;
};

struct FunctionCompareOptions {
    Tolerances tolerances;
    /// The paths are equal, so positions on them are comparable; otherwise only the order is
    /// compared.
    bool places = true;
    /// Compare G10. Not if the sides use different positioning functions, where the same work zero
    /// needs another offset, nor if they start from different stores.
    bool stores = true;
    std::size_t most_differences = 1000;
};

/// Adds a difference for each function that is missing on one side, has another value, or is
/// executed at another position of the path; the same change in many places is one difference.
/// Returns false when G10 blocks are among them: the resulting stores are then no separate
/// difference.
bool compare_functions(FunctionSide a, FunctionSide b, const FunctionCompareOptions& options,
                       Comparison& result);

}  // namespace trunnion::regression

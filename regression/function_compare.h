// The layer `functions`: are the same functions carried out in the same order and place?
#pragma once

#include "regression/comparison.h"
#include "regression/describe.h"
#include "regression/recorded_run.h"

namespace trunnion::regression {

struct FunctionCompareOptions {
    Tolerances tolerances;
    /// The paths are equal, so places on them can be compared; else only the order counts.
    bool places = true;
    /// G10 counts: not where the sides position by other functions, because the same work zero is
    /// another offset there, nor where they start from other stores.
    bool stores = true;
    std::size_t most_differences = 1000;
};

/// Adds a difference for each function that one side lacks, has another value of, or carries out at
/// another place of the path; the same change in many places is one difference. False when G10
/// blocks are among them: what they leave in the stores is no difference of its own then.
bool compare_functions(const RecordedRun& a, const RecordedRun& b,
                       const FunctionCompareOptions& options, SourceLines& lines_a,
                       SourceLines& lines_b, Comparison& result);

}  // namespace trunnion::regression

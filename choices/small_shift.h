// A difference smaller than the noise of a row, over many rows.
#pragma once

#include <vector>

#include "choices/compared_run.h"
#include "choices/log_view.h"

namespace trunnion::choices {

/// Noise of neighbouring rows is alike: so many rows count as one. At least 1.
double correlation_of(const LogView& view, const ComparedRun& run, const std::vector<int>& blocks);

/// Probability by noise alone of the clearest mean of an axis over successive blocks. 1 for means
/// below the smallest increment that is entered in practice. `correlation`: of `correlation_of`.
double p_of_shift(const LogView& view, const ComparedRun& run, const std::vector<int>& blocks,
                  double correlation);

/// Directions in which each row can differ: a sample that slides along its segment has one less.
std::vector<double> directions_of(const LogView& view, const ComparedRun& run);

}  // namespace trunnion::choices

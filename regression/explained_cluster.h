// Differences of two paths with their known causes.
#pragma once

#include <string>

#include "regression/path_compare.h"

namespace trunnion::regression {

/// Position of a cause: line from 1 in one of PathRecord::programs; 0: unknown.
struct CausePlace {
    std::uint32_t line = 0;
    std::uint16_t program = 0;
};

/// Clusters with the same cause, combined.
struct ExplainedCluster {
    PathCluster cluster;     ///< the first one, with the total count and the largest deviation
    std::string cause = {};  ///< empty: unknown
    CausePlace a = {}, b = {};
};

}  // namespace trunnion::regression

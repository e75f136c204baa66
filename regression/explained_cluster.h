// Differences of two paths with what is known of their cause.
#pragma once

#include <string>

#include "regression/path_compare.h"

namespace trunnion::regression {

/// Where a cause enters: line from 1 in one of PathRecord::programs; 0: not known.
struct CausePlace {
    std::uint32_t line = 0;
    std::uint16_t program = 0;
};

/// Clusters that one cause explains, as one.
struct ExplainedCluster {
    PathCluster cluster;     ///< the first, with the count and the worst of all
    std::string cause = {};  ///< empty: not known
    CausePlace a = {}, b = {};
};

}  // namespace trunnion::regression

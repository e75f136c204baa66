// Comparison of two recorded paths: aligns their passes, compares them, and collects differences in
// clusters.
#pragma once

#include <string>
#include <vector>

#include "regression/align.h"
#include "regression/comparison.h"
#include "regression/path_record.h"
#include "regression/stretch_compare.h"

namespace trunnion::regression {

/// A cluster with its first region, before positions are added.
struct PathCluster {
    DifferenceKind kind = DifferenceKind::path;
    PathRegion first;
    std::uint64_t count = 1;
    double position_mm = 0.0, direction_rad = 0.0;  ///< largest of the cluster
    int tool = 0;
    double cut_a_mm = 0.0, cut_b_mm = 0.0;  ///< of the passes concerned (only_a, only_b, path)
    Stretch last_a, last_b;                 ///< the last region of the cluster
};

struct PathComparison {
    std::vector<PathCluster> clusters;
    std::uint64_t left_out = 0;  ///< clusters beyond the limit
    WalkTotals totals;
    std::vector<ToolRow> tools;
    std::uint64_t approaches_differ = 0;  ///< rapids with reduced comparison, see below
};

/// When the sides use different positioning functions (e.g. G43.4 and G68.2) or machines, rapids
/// between cuts cannot agree along the path and only their ends are compared; those that differ are
/// counted in `approaches_differ`. With the same functions rapids are compared like cuts.
PathComparison compare_paths(const PathRecord& a, const PathRecord& b, const WalkOptions& options,
                             std::size_t most_clusters = 1000);

}  // namespace trunnion::regression

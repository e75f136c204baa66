// Compares two recorded paths: aligns their passes, walks them, gathers what differs in clusters.
#pragma once

#include <string>
#include <vector>

#include "regression/align.h"
#include "regression/comparison.h"
#include "regression/path_record.h"
#include "regression/stretch_compare.h"

namespace trunnion::regression {

/// A cluster with its first region, before places are named.
struct PathCluster {
    DifferenceKind kind = DifferenceKind::path;
    PathRegion first;
    std::uint64_t count = 1;
    double position_mm = 0.0, direction_rad = 0.0;  ///< worst of the cluster
    int tool = 0;
    double cut_a_mm = 0.0, cut_b_mm = 0.0;  ///< of the passes concerned (only_a, only_b, path)
    Stretch last_a, last_b;                 ///< the last region of the cluster
};

struct PathComparison {
    std::vector<PathCluster> clusters;
    std::uint64_t left_out = 0;  ///< clusters beyond the limit
    WalkTotals totals;
    std::vector<ToolRow> tools;
    std::uint64_t approaches_differ = 0;  ///< rapids not compared strictly, see below
};

/// Where both sides use different positioning functions (G43.4 here, G68.2 there) or machines,
/// rapids between cuts cannot agree on the way and only have to end alike; those that do not are
/// counted in `approaches_differ`. With the same functions rapids count like cuts.
PathComparison compare_paths(const PathRecord& a, const PathRecord& b, const WalkOptions& options,
                             std::size_t most_clusters = 1000);

}  // namespace trunnion::regression

// Why two paths differ: what the controls have in force, and what the blocks say.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "regression/explained_cluster.h"
#include "regression/recorded_run.h"
#include "regression/written_gaps.h"

namespace trunnion::regression {

/// What explaining needs beside the clusters.
struct CauseInput {
    const RecordedRun& a;
    const RecordedRun& b;
    WrittenGaps* gaps = nullptr;  ///< nullptr: no texts to look at (a golden)
    const std::optional<positioning::RotaryTransform>& transform;
    Tolerances tolerances;
};

/// Finds a cause for each cluster and makes one of those that share it. A state explains a
/// difference when it begins to differ where the paths begin to differ: two posts that use other
/// functions all along differ in states without harm.
std::vector<ExplainedCluster> explain(const std::vector<PathCluster>& clusters,
                                      const CauseInput& input);

/// "G43.4 begins with the table turned ..." where a side does so; empty otherwise.
std::string frame_hint(const RecordedRun& run, const char* side);

}  // namespace trunnion::regression

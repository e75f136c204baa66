// Causes of differences between two paths: active states of the controls, and words of the blocks.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "regression/explained_cluster.h"
#include "regression/recorded_run.h"
#include "regression/written_gaps.h"

namespace trunnion::regression {

/// Input of the explanation besides the clusters.
struct CauseInput {
    const RecordedRun& a;
    const RecordedRun& b;
    WrittenGaps& gaps;
    const std::optional<positioning::RotaryTransform>& transform;
    Tolerances tolerances;
};

/// Finds a cause for each cluster and combines clusters with the same cause. A state explains a
/// difference if it starts to differ where the paths do: two post processors with different
/// functions differ in states all along without consequence.
std::vector<ExplainedCluster> explain(const std::vector<PathCluster>& clusters,
                                      const CauseInput& input);

/// "G43.4 begins with the table turned ..." if a side does so; empty otherwise.
std::string frame_hint(const RecordedRun& run, const char* side);

}  // namespace trunnion::regression

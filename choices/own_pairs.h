// What a pair of a row and the path tells of a difference of its axes.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "choices/compared_run.h"

namespace trunnion::choices {

/// The pair of each row with its own place: a point that the log left out slides on nothing, and is
/// no nearer.
std::vector<const Pair*> own_pairs(const LogView& view, const ComparedRun& run);

/// What a constant difference of all axes does to a pair, in the order of the log's axes: nothing
/// along its segment.
Eigen::MatrixXd shown_by(const LogView& view, const ComparedRun& run, const Pair& pair);

/// First node to which an axis moves. Before, it stands where the first row of the log has it, with
/// the noise of that row.
std::size_t first_move(const ControlPath& path, Axis axis);

}  // namespace trunnion::choices

// Which rows are left out together: places of an axis, paths, and rows that a group can move.
#pragma once

#include <vector>

#include "diagnosis/prepare/prepare.h"
#include "diagnosis/search/design.h"

namespace trunnion::diagnosis {

/// Leaves out whole positions of an axis, never its ends, to test whether a table is valid between
/// positions.
Folds place_folds(const emulator::Replay& replay, const TableForm& table);

/// Leaves out all passes over the same path together (any feed and direction), and poses of probes
/// and targets one by one, to test whether a model is valid on unmeasured paths.
Folds path_folds(const std::vector<NoiseBlock>& blocks, const emulator::Replay& replay,
                 const std::vector<Axis>& axes);

/// True for each row that one of the groups can move beside the set-up.
std::vector<bool> moved_rows(const Design& design, const std::vector<std::size_t>& groups);

/// The same folds, but rows that none of the groups can move beside the set-up are never left out:
/// readings of another axis say nothing of a group, and their squares would hide what it saves.
Folds of_moved_rows(const Design& design, const std::vector<std::size_t>& groups, Folds folds);

}  // namespace trunnion::diagnosis

// Blocks of a log's rows and of a path in one numbering; rows without a number get one by position.
#pragma once

#include <vector>

#include "choices/control_path.h"
#include "choices/pairing.h"

namespace trunnion::choices {

struct RowKeys {
    std::vector<int> of_row;    ///< -1: none
    std::vector<int> of_block;  ///< of ControlPath::blocks; -1: the log has no row of it
    std::vector<int> of_node;   ///< of ControlPath::nodes, the same
    int count = 0;
};

/// A row without a number between two of one block belongs to it; between two blocks, to one of
/// those that the path has from the first to the second, in order and by distance. A log without
/// any number is one block. Throws PathEnded.
RowKeys keys_of(const LogView& log, const ControlPath& path);

/// Other keys for blocks that run several times and whose rows do not show each time: one for each
/// run of successive rows, with the times that the order of the blocks allows, the earliest and the
/// latest ones. Short moves of a repeated subprogram may have no sample in one of its passes. Empty
/// where the rows show each time, or blocks of the log are not in the order of the path.
std::vector<RowKeys> keys_by_order(const LogView& log, const ControlPath& path,
                                   const RowKeys& keys);

}  // namespace trunnion::choices

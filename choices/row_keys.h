// Blocks of a log's rows and of a path in one numbering; rows without a number get one by position.
#pragma once

#include <vector>

#include "choices/control_path.h"
#include "choices/pairing.h"

namespace trunnion::choices {

struct RowKeys {
    std::vector<int> of_row;    ///< -1: none
    std::vector<int> of_block;  ///< of ControlPath::blocks; -1: the log has no row of it
    int count = 0;
};

/// A row without a number between two of one block belongs to it; between two blocks, to one of
/// those that the path has from the first to the second, in order and by distance. A log without
/// any number is one block. Throws PathEnded.
RowKeys keys_of(const LogView& log, const ControlPath& path);

}  // namespace trunnion::choices

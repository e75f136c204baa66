// Causes beside blocks that stay so far away that nothing else counts.
#pragma once

#include "choices/gap_search.h"

namespace trunnion::choices {

/// An edited block may be a thousand times as far away as what a stale store does to all others,
/// and the score follows the mean. If a few blocks with a gap stay much farther away than most of
/// them, the search is repeated with these blocks set aside, and its result taken if the other
/// blocks come closer by it. `row_limit`: loss of a row that noise may have.
GapSearch beside_far_blocks(const SearchQuestion& question, GapSearch found, double row_limit,
                            const std::function<void(const char*)>& watch);

}  // namespace trunnion::choices

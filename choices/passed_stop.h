// What another control does before the block in which this one stops with an alarm.
#pragma once

#include <cstddef>
#include <optional>

#include "choices/compared_run.h"

namespace trunnion::choices {

/// Losses of the rows before that block, as if the log ended there.
struct BeforeStop {
    std::size_t rows = 0;
    double own = 0.0, other = 0.0;
};

/// `own` ends in an alarm. Rows that `other` assigns to later blocks say nothing but that it went
/// on, wherever the shorter path leaves them. Nothing if `other` does not come to that block.
std::optional<BeforeStop> before_stop(const Comparer& comparer, const ComparedRun& own,
                                      const ComparedRun& other);

}  // namespace trunnion::choices

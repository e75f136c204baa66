// The present readings taken once more, with one thing changed: what the owner of a laser, an
// autocollimator, a CMM, a tracker or a servo log can do next.
#pragma once

#include <vector>

#include "diagnosis/measurements.h"

namespace trunnion::diagnosis {

/// Rows of `table` whose instrument takes no NC program of ours (linear, angle, point, axis), once
/// more: on a parallel line, with the target further from the spindle nose, from the other side, at
/// more places, in reverse order, at other speeds. Empty when the table has no such row. Their
/// clock goes on at `start_s`; long tables are thinned. Each has a setup of its own where its
/// target is elsewhere.
std::vector<Measurement> repeated_measurements(const setup::Setup& setup,
                                               const records::ReadingTable& table, double start_s);

}  // namespace trunnion::diagnosis

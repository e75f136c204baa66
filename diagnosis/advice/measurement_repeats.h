// The present readings taken once more, with one thing changed: what the owner of a laser, an
// autocollimator, a CMM, a tracker or a servo log can do next.
#pragma once

#include <vector>

#include "diagnosis/advice/measurements.h"

namespace trunnion::diagnosis {

/// How the readings of a further instrument are told from those of the first.
constexpr const char* import_of_second_instrument =
    "imported with --with instrument=NAME: the setup has an [[instrument]] with a name for each, "
    "that of the present readings first";

/// Rows of `table` whose instrument takes no NC program of ours (linear, angle, point, axis), once
/// more: on a parallel line, with the target further from the spindle nose, from the other side, at
/// more places, in reverse order, along another axis, by another instrument, at other speeds. Empty
/// when the table has no such row. Their clock goes on at `start_s`; long tables are thinned. Each
/// has a setup of its own where its target is elsewhere.
std::vector<Measurement> repeated_measurements(const setup::Setup& setup,
                                               const records::ReadingTable& table, double start_s);

}  // namespace trunnion::diagnosis

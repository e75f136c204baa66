// Error maps from a table of readings: sphere rows, or the touches behind them.
#pragma once

#include "pivot/pivot_prints.h"
#include "records/readings.h"

namespace trunnion::pivot {

/// Rows with a `mode` (dpp, rtdfo, rtcp, tw). `sphere` rows give found minus expected centre
/// directly; `touch` rows of one pose give the centre by least squares (`radii_mm` the sum of both
/// radii), the expected one is where their targets lead. Rows without a mode and tests whose name
/// begins with "zero" are findings of the sphere at home; a head line `date` is the day. A map is
/// what one test turns of one axis. Throws InputError: no such rows, or fewer than three directions
/// at a pose.
PivotPrints pivot_readings(const records::ReadingTable& table, Axis first, Axis second,
                           double radii_mm, const Vector3& tip_S_mm);

}  // namespace trunnion::pivot

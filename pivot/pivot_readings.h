// Error maps from a table of readings: sphere rows, or the underlying touches.
#pragma once

#include "pivot/pivot_prints.h"
#include "records/readings.h"

namespace trunnion::pivot {

/// Uses rows with a `mode` (dpp, rtdfo, rtcp, tw). `sphere` rows give measured minus expected
/// centre directly. `touch` rows of one pose give the centre by least squares (`radii_mm` is the
/// sum of both radii); the expected centre follows from their targets. Rows without a mode and
/// tests whose name starts with "zero" measure the sphere at home; a head line `date` is the date.
/// A map contains the rotations of one axis in one test. Throws InputError when there are no such
/// rows, or fewer than three directions at a pose.
PivotPrints pivot_readings(const records::ReadingTable& table, Axis first, Axis second,
                           double radii_mm, const Vector3& tip_S_mm);

}  // namespace trunnion::pivot

// Curves as chords: arcs of segments, and any curve given as a function of 0..1.
#pragma once

#include <functional>
#include <vector>

#include "regression/segment.h"

namespace trunnion::regression {

/// The point of a segment at s in [0, 1] of its length; `start` is where the segment before ended.
PathPoint point_at(const PathPoint& start, const Segment& segment, double s);

/// Length of the position's path along a segment, mm.
double length_mm(const PathPoint& start, const Segment& segment);

/// Centre of gravity of a segment's line.
Vector3 centroid(const PathPoint& start, const Segment& segment);

/// Chords of one segment within the tolerances' chord error; appends the points after `start`, the
/// last one being exactly the segment's end.
void append_chords(const PathPoint& start, const Segment& segment, const Tolerances& tolerances,
                   std::vector<PathPoint>& points);

/// Cuts a curve given by `at` (0..1) until every chord stays within the chord error at its middle
/// and quarter; appends the points after the start. It is looked at in `pieces` equal parts at
/// least, so that whole turns do not look straight.
void sample_curve(const std::function<PathPoint(double)>& at, int pieces,
                  const Tolerances& tolerances, std::vector<PathPoint>& points);

}  // namespace trunnion::regression

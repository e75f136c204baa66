// Approximation of curves by chords: arcs of segments, and any curve given as a function on [0, 1].
#pragma once

#include <functional>
#include <vector>

#include "regression/segment.h"

namespace trunnion::regression {

/// The point of a segment at fraction s in [0, 1] of its length; `start` is the end of the previous
/// segment.
PathPoint point_at(const PathPoint& start, const Segment& segment, double s);

/// Path length of the position along a segment, mm.
double length_mm(const PathPoint& start, const Segment& segment);

/// Centroid of a segment's line.
Vector3 centroid(const PathPoint& start, const Segment& segment);

/// Chords of one segment within the chord error of the tolerances. Appends the points after
/// `start`; the last one is exactly the segment's end.
void append_chords(const PathPoint& start, const Segment& segment, const Tolerances& tolerances,
                   std::vector<PathPoint>& points);

/// Divides a curve `at` on [0, 1] until every chord is within the chord error at its middle and
/// quarter points; appends the points after the start. It starts with at least `pieces` equal
/// parts, so that whole turns do not appear straight.
void sample_curve(const std::function<PathPoint(double)>& at, int pieces,
                  const Tolerances& tolerances, std::vector<PathPoint>& points);

}  // namespace trunnion::regression

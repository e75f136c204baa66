// Rates of the axes along a move, and the limits set by axis speed and acceleration.
#pragma once

#include "motion/axis_limits.h"
#include "motion/motion.h"

namespace trunnion::motion {

/// Rates of a move with s from 0 to 1; axis units are mm and rad.
struct PathRates {
    AxisPositions start, end;         ///< d axis / d s; 0 for curves when no axis has an
                                      ///< acceleration limit
    double least_s = 0.0;             ///< minimum duration allowed by the axis speed limits at
                                      ///< constant ds/dt, s
    double least_bend_s = 0.0;        ///< minimum duration allowed by centripetal acceleration
                                      ///< (v^2/r) at the sharpest bend, s
    double least_acceleration = 0.0;  ///< s^2: inverse of the largest allowed d2s/dt2
};

/// Lines are evaluated at their ends. Arcs use tangent and curvature, so that v^2/r stays within
/// the acceleration limit. Curves are sampled with `curve_parts` intervals.
PathRates path_rates(const AxisMove& move, const AxisLimits& limits);

}  // namespace trunnion::motion

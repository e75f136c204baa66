// How the axes run along a move: what their speeds and accelerations allow it.
#pragma once

#include "motion/axis_limits.h"
#include "motion/motion.h"

namespace trunnion::motion {

/// Of a move whose s runs from 0 to 1; axis units are mm and rad.
struct PathRates {
    AxisPositions start, end;         ///< d axis / d s; of curves 0 where nothing accelerates
    double least_s = 0.0;             ///< the speeds let it take so long at constant ds/dt
    double least_bend_s = 0.0;        ///< the same of v^2/r at the sharpest place
    double least_acceleration = 0.0;  ///< s^2: its inverse is the highest d2s/dt2
};

/// A line by its ends; an arc by the tangent (speed, speeding up) and by its curvature, so v^2/r
/// stays within the acceleration; a curve by looking at it, as finely as `curve_parts` says.
PathRates path_rates(const AxisMove& move, const AxisLimits& limits);

}  // namespace trunnion::motion

// Sections of a move without reversal of any axis.
#pragma once

#include <array>
#include <vector>

#include "motion/motion.h"

namespace trunnion::compensation {

/// Sign of the motion of each axis: -1, +1, 0 at rest.
using Travel = std::array<signed char, axis_count>;

struct PathStretch {
    double from = 0.0, to = 1.0;  ///< s of the move
    Travel travel{};
};

/// In order, without gaps, at least one.
std::vector<PathStretch> path_stretches(const motion::AxisMove& move);

}  // namespace trunnion::compensation

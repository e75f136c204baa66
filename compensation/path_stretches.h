// Parts of a move in which no axis turns round.
#pragma once

#include <array>
#include <vector>

#include "motion/motion.h"

namespace trunnion::compensation {

/// Sign of the motion of each axis: -1, +1, 0 for one that stands.
using Travel = std::array<signed char, axis_count>;

struct PathStretch {
    double from = 0.0, to = 1.0;  ///< s of the move
    Travel travel{};
};

/// In order, without gaps, at least one.
std::vector<PathStretch> path_stretches(const motion::AxisMove& move);

}  // namespace trunnion::compensation

// The fewest stored numbers that explain differences of programmed points.
#pragma once

#include "diagnosis/stores/programmed_points.h"

namespace trunnion::diagnosis {

/// Some numbers changed, the others as declared.
struct NumberSet {
    std::vector<std::size_t> members;
    Eigen::VectorXd change_mm, sigma_mm;  ///< sigma NaN: not determined
    double left = 0.0;                    ///< sum of squares, mm^2
    std::vector<Eigen::VectorXd> null_space = {};
};

/// Sets of at most this size are all tried, then only all numbers together.
constexpr std::size_t most_numbers = 3;

/// The smallest sets that leave no more than all numbers together, the best one first.
std::vector<NumberSet> smallest_sets(const PointEquations& equations);

}  // namespace trunnion::diagnosis

// Readings that every visit of a place finds alike (agreeing_visits.cpp).
#pragma once

#include <vector>

#include "diagnosis/prepare/prepare.h"

namespace trunnion::diagnosis {

/// Number of the visit of each row: readings at one position of the axes, one after the other.
std::vector<std::size_t> visits_of(const emulator::Replay& replay);

/// Of rows that are far off, in ascending order, those that may be spoiled. What most visits of a
/// place find alike, two at least, is an error of that place: a bad tooth, a bad mark. `left`:
/// residuals of all rows, in sigma.
std::vector<std::size_t> without_agreeing(const Prepared& prepared, const std::vector<bool>& used,
                                          std::vector<std::size_t> rows,
                                          const Eigen::VectorXd& left);

}  // namespace trunnion::diagnosis

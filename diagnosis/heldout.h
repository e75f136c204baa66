// How far the gap shrinks on readings that took no part in the fit.
#pragma once

#include "diagnosis/candidates.h"
#include "diagnosis/diagnosis.h"

namespace trunnion {

/// Rows cut into groups that share errors or neighbourhood: the readings of one pose, arcs of a
/// sixth of a pass. A fold holds out whole groups.
struct Folds {
    static constexpr int count = 5;
    std::vector<int> group;  ///< by device row
    std::vector<int> fold;   ///< by group
};
Folds make_folds(const std::vector<NoiseBlock>& blocks, std::size_t rows);

/// Readings before and after, with what each expects from noise alone, by group.
struct SquaredSums {
    std::vector<double> before, after, noise, rows;  ///< sums over each group, mm^2
};

/// From sums to the reported figures: shrink and its bootstrap interval.
/// `doubt` is the relative standard error of the noise variance.
HeldOut summarise(const SquaredSums& sums, std::uint64_t seed, double doubt);

/// Group-wise cross-validation of the base with the effects `members` added, against the base
/// alone. `used` marks rows that count. The interval is left at the shrink (ShrinkDraws has it).
HeldOut cross_validate(const Design& design, const BaseModel& base, const Folds& folds,
                       const std::vector<std::size_t>& members, double scale,
                       const Eigen::VectorXd& noise_mm, const std::vector<bool>& used);

}  // namespace trunnion

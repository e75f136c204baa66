// The zeros of the cycles of a laser test, taken off the differences of its repeats
// (cycle_zeros.cpp).
#pragma once

#include <vector>

#include "diagnosis/prepare/repeats.h"

namespace trunnion::diagnosis {

/// The cycles, of which one in whose middle the zero jumps (a lost count, a foot that slipped) is
/// two. `list`: differences of single readings, in units of `sigma_mm` of the two; `least`: smaller
/// deviations are the last digit.
std::vector<Eigen::Index> split_at_jumps(const std::vector<Eigen::Index>& cycle,
                                         const Eigen::VectorXd& sigma_mm, double least,
                                         const std::vector<Stretch>& list);

/// The zero of each row's cycle, and the deviation of the differences beside the zeros.
struct RepeatScatter {
    Eigen::VectorXd zero_mm;  ///< of each device row
    double deviation = 0.0;   ///< in units of the sigma of a difference
};
RepeatScatter scatter_beside_zeros(const std::vector<Eigen::Index>& cycle,
                                   const Eigen::VectorXd& sigma_mm, double least,
                                   const std::vector<Stretch>& list);

/// Takes off what all readings of a cycle have in common: its zero may differ from that of the one
/// before. A cycle of few differences belongs to the one before. Spoiled differences take no part.
/// What is left is scaled by the freedom that the zeros take.
void remove_zeros_of_cycles(const std::vector<Eigen::Index>& cycle, const Eigen::VectorXd& sigma_mm,
                            double least, std::vector<Stretch>& list);

}  // namespace trunnion::diagnosis

// What the blocks of readings that are left out together say of one member.
#pragma once

#include <cstddef>

#include "diagnosis/prepare/prepare.h"
#include "diagnosis/verdict/shares.h"

namespace trunnion::diagnosis {

/// Probability at most of what that many blocks of readings saw (Laplace's rule of succession).
double seen_by(double blocks);

/// Number of blocks that see a member: of blocks alike their count, of what one block alone shows
/// 1 (exponential of the entropy of the parts of its squares).
double blocks_that_see(const Sizes& sizes, std::size_t position, const Folds& folds);

/// Tempering exponent: compares block scores of a member with those expected from noise of this
/// variance. 1 when blocks are independent; smaller when the residual follows the member over whole
/// blocks.
double temper(const Sizes& sizes, std::size_t position, const Folds& folds, double variance);

}  // namespace trunnion::diagnosis

// Noise of a log that neither states nor shows it by its density: few rows a block, ends of moves.
#pragma once

#include <optional>
#include <vector>

#include "choices/compared_run.h"

namespace trunnion::choices {

struct SparseNoise {
    double sigma = 0.0;    ///< mm or deg, of the axis that scatters most
    double freedom = 0.0;  ///< numbers of which it is known
};

/// What neighbouring rows scatter about the path: rows of one block, or where blocks have one row,
/// of neighbour blocks; of all axes together where each has few. A difference that is alike in both
/// of them is no noise, and neither are the few where another one begins. Nothing without enough of
/// them, or where it is more than any display or drive has.
std::optional<SparseNoise> sparse_noise(const LogView& view, const ComparedRun& run,
                                        const std::vector<int>& blocks);

/// Probability that noise depends as much on the positions, the direction of travel and the order
/// of the rows as the differences of the axis do that depends most on them.
double p_of_dependence(const LogView& view, const ComparedRun& run);

}  // namespace trunnion::choices

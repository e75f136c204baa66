// Which set of effects explains the gap: Gaussian evidence of sets, searched by a beam.
#pragma once

#include <vector>

#include "diagnosis/candidates.h"

namespace trunnion {

/// A set of candidates (indices into Design::candidates, rising) with its evidence against none.
struct EffectSet {
    std::vector<std::size_t> members;
    double log_evidence = 0.0;  ///< log Bayes factor against the empty set, with priors
    double scale = 1.0;         ///< of the prior that served best
    double explained = 0.0;     ///< fall of the whitened squared sum
};

struct SearchOptions {
    std::size_t width = 12;
    std::size_t largest = 5;
    double noise_variance = 1.0;  ///< of the whitened data
};

/// Evidence of one set, mean over prior scales 0.3, 1, 3, 10 of the catalogue's typical sizes.
EffectSet evaluate(const Design& design, std::vector<std::size_t> members,
                   const SearchOptions& options);

/// All sets met by the beam, best first; the empty set is among them.
std::vector<EffectSet> search_sets(const Design& design, const SearchOptions& options);

std::vector<Eigen::Index> columns_of(const Design& design, const std::vector<std::size_t>& members);

}  // namespace trunnion

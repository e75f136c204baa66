#include "diagnosis/verdict/block_evidence.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace trunnion::diagnosis {
namespace {

/// Of each block: the product of what a member does with what is left, and its square.
struct OfBlocks {
    std::vector<double> score, own;
};

OfBlocks by_block(const Sizes& sizes, std::size_t position, const Folds& folds) {
    OfBlocks of{std::vector<double>(folds.fold.size(), 0.0),
                std::vector<double>(folds.fold.size(), 0.0)};
    for (std::size_t i = 0; i < folds.group.size(); ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        const double c = sizes.parts(row, static_cast<Eigen::Index>(position));
        const auto block = static_cast<std::size_t>(folds.group[i]);
        of.score[block] += c * sizes.remainder(row);
        of.own[block] += c * c;
    }
    return of;
}

}  // namespace

double seen_by(double blocks) {
    return (blocks + 1.0) / (blocks + 2.0);
}

double blocks_that_see(const Sizes& sizes, std::size_t position, const Folds& folds) {
    const std::vector<double> own = by_block(sizes, position, folds).own;
    const double sum = std::accumulate(own.begin(), own.end(), 0.0);
    if (sum <= 0.0) return 0.0;
    double entropy = 0.0;
    for (const double square : own)
        if (square > 0.0) entropy -= square / sum * std::log(square / sum);
    return std::exp(entropy);
}

double temper(const Sizes& sizes, std::size_t position, const Folds& folds, double variance) {
    const OfBlocks of = by_block(sizes, position, folds);
    double square = 0.0, expected = 0.0;
    for (std::size_t b = 0; b < of.own.size(); ++b) {
        square += of.score[b] * of.score[b];
        expected += variance * of.own[b];
    }
    return 1.0 / std::max(1.0, expected > 0.0 ? square / expected : 1.0);
}

}  // namespace trunnion::diagnosis

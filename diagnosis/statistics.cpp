#include "diagnosis/statistics.h"

#include <bit>
#include <cmath>
#include <cstddef>

namespace trunnion {
std::vector<double> shapley(const std::vector<double>& worth, int players) {
    std::vector<double> weight(static_cast<std::size_t>(players));
    for (int k = 0; k < players; ++k)
        weight[static_cast<std::size_t>(k)] =
            std::exp(std::lgamma(k + 1.0) + std::lgamma(players - k) - std::lgamma(players + 1.0));
    std::vector<double> share(static_cast<std::size_t>(players), 0.0);
    for (int k = 0; k < players; ++k)
        for (unsigned mask = 0; mask < (1U << players); ++mask) {
            const unsigned with = mask | 1U << k;
            if (with == mask) continue;
            share[static_cast<std::size_t>(k)] +=
                weight[static_cast<std::size_t>(std::popcount(mask))] * (worth[with] - worth[mask]);
        }
    return share;
}

}  // namespace trunnion

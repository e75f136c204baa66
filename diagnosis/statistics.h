// Shares of a joint effect that do not depend on an order.
#pragma once

#include <vector>

#include "estimation/distributions.h"
#include "estimation/quantiles.h"

namespace trunnion {

/// Shapley shares of a game over `players` <= 12: `worth[mask]` is what the subset explains. The
/// shares add up to worth[all] - worth[none] whatever the order of the players.
std::vector<double> shapley(const std::vector<double>& worth, int players);

}  // namespace trunnion

// Uncertainty of an identification by Monte Carlo repetition, as an alternative to the covariance.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "identification/identify.h"

namespace trunnion::identification {

/// Result of one repetition.
struct Repetition {
    int index = 0;            ///< from 0
    std::vector<double> off;  ///< value minus fitted value of each parameter, in their order
};

/// The repetitions to do: every `step`-th of `runs`, starting at `first` (0 to step-1).
struct RepetitionPlan {
    int runs = 0;
    std::uint64_t seed = 1;
    int first = 0, step = 1;
    unsigned threads = 1;
    /// Called after each repetition, from any thread; false ends the work, and completed
    /// repetitions count.
    std::function<bool(int done)> go_on;
};

/// Simulates the readings of the fitted setup with new noise of each row's sigma and identifies
/// again from `setup`. Repetition k has its own seed, so the numbers do not depend on thread or
/// shard. Correlation between rows is not simulated. Returned in the order of their index; fewer
/// than planned when `go_on` ended the work. Throws like identify.
std::vector<Repetition> repeat_identification(const setup::Setup& setup,
                                              const records::ReadingTable& table,
                                              const std::vector<std::string>& effects,
                                              const RepetitionPlan& plan,
                                              const Identification& fitted);

/// Standard deviation of each parameter over the repetitions (at least two), in the order of `off`.
std::vector<double> spread(const std::vector<Repetition>& repetitions);

/// Sets `sigma_monte_carlo` of each parameter; NaN when it is not separable. No effect with fewer
/// than two repetitions.
void enter_spread(const std::vector<Repetition>& repetitions, Identification& fitted);

}  // namespace trunnion::identification

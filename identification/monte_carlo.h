// Uncertainty of an identification by simulated repetition, beside the one by covariance.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "identification/identify.h"

namespace trunnion::identification {

/// What one repetition gave.
struct Repetition {
    int index = 0;            ///< from 0
    std::vector<double> off;  ///< value less the fitted one, of each parameter in their order
};

/// Which repetitions to do: every `step`-th of `runs`, from `first` (0 to step-1).
struct RepetitionPlan {
    int runs = 0;
    std::uint64_t seed = 1;
    int first = 0, step = 1;
    unsigned threads = 1;
    /// Asked after each repetition, from any thread: false ends them, and those done count.
    std::function<bool(int done)> go_on;
};

/// Readings that the fitted setup would give, with fresh noise of each row's own sigma, identified
/// again from `setup`. Repetition k has its own seed: the same numbers whatever the thread or shard
/// that does it. Correlation between rows is not simulated. In the order of their index; fewer
/// than planned when `go_on` ended them. Throws what identify throws.
std::vector<Repetition> repeat_identification(const setup::Setup& setup,
                                              const records::ReadingTable& table,
                                              const std::vector<std::string>& effects,
                                              const RepetitionPlan& plan,
                                              const Identification& fitted);

/// Standard deviation of each parameter over two repetitions or more, in the order of `off`.
std::vector<double> spread(const std::vector<Repetition>& repetitions);

/// Fills `sigma_monte_carlo` of each parameter; NaN for one that cannot be told apart. Below two
/// repetitions nothing is filled in.
void enter_spread(const std::vector<Repetition>& repetitions, Identification& fitted);

}  // namespace trunnion::identification

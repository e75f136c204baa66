// Uncertainty of an identification by simulated repetition, beside the one by covariance.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "identification/identify.h"

namespace trunnion::identification {

/// Fills `sigma_monte_carlo` of each parameter of `fitted`: its standard deviation over `runs` (2
/// or more) repetitions of readings that the fitted setup would give, with fresh noise of each
/// row's own sigma, identified again from `setup`. NaN for a parameter that cannot be told apart.
/// Same seed, same numbers. Correlation between rows is not simulated.
/// `go_on` is asked after each repetition: false ends them, and those done count. Returns how many
/// were done; below 2 nothing is filled in.
int add_monte_carlo(const setup::Setup& setup, const records::ReadingTable& table,
                    const std::vector<std::string>& effects, int runs, std::uint64_t seed,
                    Identification& fitted, const std::function<bool(int done)>& go_on = {});

}  // namespace trunnion::identification

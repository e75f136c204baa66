// Distributions and small statistics that decide whether a difference is more than chance.
#pragma once

#include <vector>

namespace trunnion {

double chi_squared_tail(double value, double freedom);              ///< P(X > value)
double f_tail(double value, double numerator, double denominator);  ///< P(F > value)
double normal_tail(double value);                                   ///< P(Z > value)
double median(std::vector<double> values);                          ///< 0 for none
/// Quantile by linear interpolation, `share` in 0..1.
double quantile(std::vector<double> values, double share);

/// Shapley shares of a game over `players` <= 12: `worth[mask]` is what the subset explains. The
/// shares add up to worth[all] - worth[none] whatever the order of the players.
std::vector<double> shapley(const std::vector<double>& worth, int players);

}  // namespace trunnion

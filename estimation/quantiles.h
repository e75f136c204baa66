// Order statistics of small samples.
#pragma once

#include <vector>

namespace trunnion::estimation {

/// Quantile by linear interpolation between the sorted values, `share` in [0, 1]; 0 for no values.
double quantile(std::vector<double> values, double share);
double median(std::vector<double> values);  ///< 0 for no values
/// Median absolute value divided by that of the standard normal distribution: an estimate of the
/// standard deviation that is robust against outliers. 0 for no values.
double robust_deviation(std::vector<double> values);

}  // namespace trunnion::estimation

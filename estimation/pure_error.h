// Noise variance from repeated readings alone, independent of any model.
//
// Model       v_i = m(setting_i) + e_i, e ~ N(0, s^2). Settings with a single reading do not count.
// Failure     none. Without repeats freedom and variance are 0.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace trunnion::estimation {

struct PureError {
    double variance = 0.0;  ///< s^2, in squared units of the values
    double freedom = 0.0;   ///< number of readings minus number of settings
    /// Relative standard error of the variance; 0 without freedom.
    double doubt() const;
};

/// `setting` has one entry for each value; negative: the reading is excluded. Deviations beyond
/// `limit` robust standard deviations are clipped to that size.
PureError pure_error(const Eigen::VectorXd& values, const std::vector<int>& setting,
                     double limit = 6.0);

}  // namespace trunnion::estimation

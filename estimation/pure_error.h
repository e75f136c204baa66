// The size of the noise from repeated readings alone: no model takes part.
//
// Model       v_i = m(setting_i) + e_i, e ~ N(0, s^2). Settings without a second reading say
// nothing. Fails       never; freedom 0: nothing was repeated, variance is 0.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace trunnion::estimation {

struct PureError {
    double variance = 0.0;  ///< s^2, in units of the values squared
    double freedom = 0.0;   ///< readings less settings
    /// Relative standard error of the variance; 0 without freedom.
    double doubt() const;
};

/// `setting` has one entry for each value; negative: the reading takes no part. A value that is
/// more than `limit` robust deviations from its setting's mean counts as that far.
PureError pure_error(const Eigen::VectorXd& values, const std::vector<int>& setting,
                     double limit = 6.0);

}  // namespace trunnion::estimation

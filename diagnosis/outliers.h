// Readings that stand out: left out when they are few and scattered, kept when they crowd together.
#pragma once

#include "diagnosis/prepare.h"

namespace trunnion::diagnosis {

/// Probe readings far from the set-up alone, the worst first and the fit anew each time. Not for
/// the ballbar, where one reading at each reversal may be all that shows of a spike. Device rows,
/// rising; empty when there are more than 4 % of them or they crowd together.
std::vector<std::size_t> lone_probe_readings(const Prepared& prepared,
                                             const std::vector<bool>& used);

/// Readings of `used` far from what a model leaves (`left`, over the noise): the same rule.
std::vector<std::size_t> wild_readings(const Eigen::VectorXd& left, const std::vector<bool>& used);

}  // namespace trunnion::diagnosis

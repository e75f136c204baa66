// The next measurement, chosen to separate two effects that these readings cannot distinguish.
#pragma once

#include "diagnosis/advice/measurements.h"
#include "diagnosis/prepare/noise.h"
#include "diagnosis/prepare/prepare.h"
#include "diagnosis/search/column_group.h"

namespace trunnion::diagnosis {

/// A fitted effect and a rival that could replace it.
struct AmbiguousPair {
    const ColumnGroup* claimed = nullptr;
    Eigen::VectorXd values;  ///< of the claimed columns, in typical changes
    const ColumnGroup* rival = nullptr;
    double believed = 1.0;  ///< probability that the truth is one of its causes
};

/// For each pair, the ready measurement with the largest predicted discrimination for each minute:
/// half the chi-squared that the rival, refitted with the base on old and new rows together, cannot
/// reproduce, beyond the present value, under the noise found in the old readings. Reports pairs
/// that no measurement separates. `go_on` is called between steps; false ends the planning with the
/// pairs completed so far.
std::vector<NextMeasurement> plan_next(const Prepared& prepared, const NoiseModel& noise,
                                       const std::vector<AmbiguousPair>& pairs,
                                       const std::function<bool()>& go_on);

}  // namespace trunnion::diagnosis

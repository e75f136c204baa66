// What to measure next, so that two effects which these readings cannot tell apart come apart.
#pragma once

#include "diagnosis/column_group.h"
#include "diagnosis/diagnosis.h"
#include "diagnosis/prepare.h"

namespace trunnion::diagnosis {

/// An effect as fitted, and one that could be it instead.
struct AmbiguousPair {
    const ColumnGroup* claimed = nullptr;
    Eigen::VectorXd values;  ///< of the claimed columns, in typical changes
    const ColumnGroup* rival = nullptr;
};

/// For each pair the ready measurement with the largest predicted discrimination a minute: half the
/// chi-squared that the rival, refitted with the base on old and new rows together, cannot follow,
/// beyond what it cannot follow already. Pairs that no measurement separates say so. `go_on` is
/// asked between its steps: false ends it with the pairs that are done.
std::vector<NextMeasurement> plan_next(const Prepared& prepared,
                                       const std::vector<AmbiguousPair>& pairs,
                                       const std::function<bool()>& go_on);

}  // namespace trunnion::diagnosis

// What to measure next, so that two effects which these readings cannot tell apart come apart.
#pragma once

#include "diagnosis/candidates.h"
#include "diagnosis/diagnosis.h"

namespace trunnion {

/// An effect as fitted, and one that could be it instead.
struct AmbiguousPair {
    const Candidate* claimed = nullptr;
    Eigen::VectorXd values;  ///< of the claimed columns, in typical changes
    const Candidate* rival = nullptr;
};

/// For each pair the ready measurement with the largest predicted discrimination a minute: half the
/// chi-squared that the rival, refitted with the base on old and new rows together, cannot follow,
/// beyond what it cannot follow already. Pairs that no measurement separates say so. `go_on` is
/// asked between its steps: false ends it with the pairs that are done.
std::vector<NextMeasurement> plan_next(const Design& design, const BaseModel& base,
                                       const Catalogue& catalogue,
                                       const std::vector<AmbiguousPair>& pairs, double end_s,
                                       const std::function<bool()>& go_on);

}  // namespace trunnion

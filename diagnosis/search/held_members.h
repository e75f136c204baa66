// Members of a model at their variances, factored once for all that is asked
// beside them.
#pragma once

#include <map>
#include <vector>

#include "estimation/variance_groups.h"

namespace trunnion::diagnosis {

struct HeldMembers {
    std::vector<std::size_t> members;
    estimation::Variances variances;
    estimation::GroupEquations equations;
    estimation::GivenMembers given;

    /// What the members take and leave of a group.
    struct Seen {
        Eigen::MatrixXd taken;
        estimation::GroupInformation left;
    };
    std::map<std::size_t, Seen> seen;                ///< of groups that were offered
    std::vector<estimation::GroupInformation> each;  ///< beside the others; empty until needed
};

}  // namespace trunnion::diagnosis

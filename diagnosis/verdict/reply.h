// What a cause answers a contender that does without it (reply.cpp).
#pragma once

#include <string>
#include <vector>

#include "diagnosis/verdict/contenders.h"

namespace trunnion::diagnosis {

/// Causes that the contender has and the chosen model has not, and that do in it what `part` (a
/// contribution to the whitened readings) does; the largest first.
std::vector<std::size_t> in_place_of(Design& design, const Model& chosen, const Model& contender,
                                     const Eigen::VectorXd& part);

/// The best model of a contender's members with the cause back among them, beside these or in place
/// of one that does what the cause did. A contender is a longer search: what else it found may
/// stand beside the cause as well, and is no evidence against it.
Model reply_to(const Searching& search, const Model& chosen, const Model& contender,
               const std::string& cause);

}  // namespace trunnion::diagnosis

// In which order causes are told (order.cpp).
#pragma once

#include <vector>

#include "diagnosis/verdict/claims.h"

namespace trunnion::diagnosis {

/// What is claimed by its share, the smaller of two parts of one error behind, and then what is
/// rather not there. Most of the gap does not stand behind, where only its name is open.
void put_in_order(const Design& design, const Model& model, std::vector<Claim>& claims);

}  // namespace trunnion::diagnosis

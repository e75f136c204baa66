// What each cause does of the gap (shares.cpp).
#pragma once

#include <vector>

#include "diagnosis/verdict/claims.h"

namespace trunnion::diagnosis {

/// Share of each member in the gap, 0 to 1: its contribution along that of all causes. Causes that
/// cancel each other divide what they do together by chance (the line of a slide and the place of
/// an axis that carries it): where one of size goes hardly along the others, each has the mean of
/// what it explains alone and of what is lost without it, in proportion.
std::vector<double> shares_of(Design& design, const Model& model, const Sizes& sizes);

}  // namespace trunnion::diagnosis

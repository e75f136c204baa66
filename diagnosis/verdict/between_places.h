// What a table of an error leaves between its places.
#pragma once

#include <functional>

#include "diagnosis/search/solution.h"

namespace trunnion::diagnosis {

/// Fraction of the squares of the causes of a model that its tables leave on readings between their
/// places, because a control and a setup interpolate on a straight line: mean square of f'' h^2 / 8
/// with f'' from the second differences of the values, 8/15 of its square at the middle. A lower
/// bound where the places are too far from each other to show the curvature. 0 without tables of
/// three places that `interpolates` accepts (index of the group).
double left_between_places(Design& design, const Model& model,
                           const std::function<bool(std::size_t)>& interpolates);

}  // namespace trunnion::diagnosis

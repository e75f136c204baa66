// Evidence of a model whose members belong together: the textbook part of an error that also has a
// form of its own, and the slope of an axis that runs on a bow.
#pragma once

#include "diagnosis/search/search.h"

namespace trunnion::diagnosis {

/// True for the angle of the mean line of an axis that runs on a bowed line: a straightness, in
/// textbook or free form, of an axis of the plane.
bool is_its_slope(const ColumnGroup& squareness, const ColumnGroup& straightness);

/// Evidence of a model, nats. An error with a form of its own has a textbook part as often as not:
/// that is no second improbable cause beside the table. Nor is the squareness of an axis with a
/// bow.
double weight_of(Design& design, const Model& model);

}  // namespace trunnion::diagnosis

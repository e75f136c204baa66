// How far an axis goes beyond its command: what a pitch error compensation takes away
// (beyond_command.cpp).
#pragma once

#include "diagnosis/diagnosis.h"
#include "diagnosis/search/column_group.h"
#include "effects/catalogue.h"

namespace trunnion::diagnosis {

/// Of a free form along (of a rotary axis: about) its axis; else empty. A turn ends with its first
/// place again.
BeyondCommand beyond_command(const ColumnGroup& group, const Eigen::VectorXd& coefficients);

/// A control that compensates one error of an axis has to compensate the others: adds to the first
/// cause that tells how far an axis goes too far what the other claimed ones and a claimed textbook
/// form (scale, positioning) do, and names them in `includes`. The others tell nothing then.
void join_of_axis(const effects::Catalogue& catalogue, std::vector<Cause>& causes);

}  // namespace trunnion::diagnosis

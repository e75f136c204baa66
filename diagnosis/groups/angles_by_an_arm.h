// Angular errors that the readings see through one arm only.
#pragma once

#include "diagnosis/search/design.h"

namespace trunnion::diagnosis {

/// Angles seen through one arm are the other errors of the axis, whose names come first (ISO 230-1:
/// positioning, straightness, squareness): they have half the prior. Each turn is asked by itself:
/// on a plate at one height the yaw is seen through many arms, roll and pitch through one. Each of
/// those then becomes a form of its own, because two of them do the work of a scale and of a
/// squareness, and the others are another form. Turns that the readings tell are one form together.
/// Angles of several axes that do the same share the prior of one. Call it when the textbook groups
/// are in the design.
void favour_motions_over_angles(Design& design);

/// True where the readings see all turns of the angles through several arms.
bool are_told_by_themselves(const Design& design, const ColumnGroup& angles);

}  // namespace trunnion::diagnosis

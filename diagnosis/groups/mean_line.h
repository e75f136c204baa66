// Straightness from the mean line of the measured travel (ISO 230-1).
#pragma once

#include "diagnosis/prepare/prepare.h"
#include "diagnosis/search/column_group.h"

namespace trunnion::diagnosis {

/// Slope and bow of an error, in typical sizes: the bow about the mean line of the measured travel.
Eigen::Vector2d bow_about_mean_line(const Prepared& p, const effects::Effect& effect,
                                    std::size_t bow);

/// True where a bow about the zero of the axis lies mostly to one side of the measured travel: that
/// is a squareness, and a bow whose vertex stands at that zero by accident.
bool is_bow_to_one_side(const Prepared& prepared, const ColumnGroup& group);

/// Binds the slope in each direction to the bow, so that the bow is one about the mean line of the
/// measured travel. ISO 230-1 takes straightness from that line; its slope is squareness.
void take_bow_from_mean_line(const Prepared& prepared, ColumnGroup& group);

}  // namespace trunnion::diagnosis

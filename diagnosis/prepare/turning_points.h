// Readings of a dense pass at exact turning points (turning_points.cpp).
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "diagnosis/prepare/prepare.h"

namespace trunnion::diagnosis {

struct WithoutTurningPoints {
    records::ReadingTable table;
    std::size_t readings = 0;  ///< that were left out
};

/// The table without the readings of a ballbar or a servo log at rows where an axis stands exactly
/// at its turning point (every 90 degrees of a circle). An axis
/// with play has not crossed its gap there, or has: the row does not tell, and a few readings that
/// are half a gap off look like a spike or a form. Their positions stay. Empty without such
/// readings, or where they are more than a quarter (a coarse circle).
std::optional<WithoutTurningPoints> without_turning_points(const records::ReadingTable& table);

/// Readings (device rows) with which a test of a ballbar begins at a turning point, or just before
/// one: from which side it was reached was not recorded.
std::vector<std::size_t> turning_starts(const Prepared& prepared);

}  // namespace trunnion::diagnosis

// Values of an ISO 230-2 table in the order taken, however the table is laid out.
#pragma once

#include <string>
#include <vector>

#include "imports/columns.h"
#include "imports/import.h"

namespace trunnion::imports {

/// One value. `target` in mm or rad of the axis, `deviation` in mm or rad of the device.
struct IsoPoint {
    double target = 0.0, deviation = 0.0, time_s = 0.0;
    int run = 0;
    int direction = 0;  ///< +1 towards larger positions, -1
    std::size_t row = 0;
};

/// The values of one axis in one table.
struct IsoSeries {
    std::string axis;  ///< as the file names it; empty: it does not
    std::vector<IsoPoint> points;
    bool dated = false;  ///< times count from 1970
};

/// What the numbers of a table are: of the axis, and of the device that read them.
struct IsoQuantities {
    Quantity target = Quantity::length, value = Quantity::length;
};

/// Targets in rows and a column for each run and direction; or runs in rows and a column for each
/// target; or one value a line, for one axis or several. Passes in the order taken. Throws
/// InputError with its place; `result.notes` gets what was assumed.
std::vector<IsoSeries> read_iso_points(const TextTable& table, const Facts& facts,
                                       const IsoQuantities& quantities, Imported& result);

}  // namespace trunnion::imports

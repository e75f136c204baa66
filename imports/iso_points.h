// Values of an ISO 230-2 table in measured order, for any table layout.
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
    int line = 0;  ///< of the file
};

/// The values of one axis in one table.
struct IsoSeries {
    std::string axis;  ///< name in the file; empty: not given
    std::vector<IsoPoint> points;
    bool dated = false;  ///< times are seconds since 1970
    bool timed = false;  ///< the file has times
};

/// Quantities of a table: of the axis, and of the device that read it.
struct IsoQuantities {
    Quantity target = Quantity::length, value = Quantity::length;
};

/// "Position;0;100;200" above "Run 1 up;0,1;0,3;0,2".
bool targets_across(const TextTable& table);

/// Times of points without any: a row each minute, or --with step_s=.
void step_times(const Facts& facts, std::vector<IsoPoint>& points);

/// Layouts: targets in rows and a column for each run and direction; runs in rows and a column for
/// each target; one value a line, for one axis or several. Returns passes in measured order, with
/// the values of the file for `deviation`. Throws InputError with position; `result.notes` gets the
/// assumptions.
std::vector<IsoSeries> read_iso_points(const TextTable& table, const Facts& facts,
                                       const IsoQuantities& quantities, Imported& result);

}  // namespace trunnion::imports

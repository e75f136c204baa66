// Numbers of an ISO 230-2 table: units, and positions or deviations.
#pragma once

#include <string>
#include <vector>

#include "imports/iso_points.h"

namespace trunnion::imports {

/// A table and the known facts about its numbers.
struct IsoSource {
    const TextTable& table;
    const Facts& facts;
    IsoQuantities quantities;
    std::size_t target = 0;  ///< column
    double factor = 1.0;     ///< of the targets, to mm or rad
    /// Direction told above the table or by --with sense=: +1 or -1; 0: both ways, or none told.
    int way = 0;
    std::string way_text;
    int heading_line = 0;  ///< line of the heading that tells it; 0: none does
};

std::string usual_unit(Quantity quantity);
/// Factor of a column of values. Without a unit, values that follow their targets are positions in
/// the unit of these. Throws InputError for a column without any unit, and for one whose unit is
/// told elsewhere, but that has the numbers of its targets in another unit.
double value_factor(const IsoSource& source, std::size_t column);
/// Throws InputError when the points have the numbers of their targets in another unit.
void refuse_numbers_of_targets(const IsoSource& source, const std::vector<IsoPoint>& points,
                               double target_factor, double value_factor);
/// A note on the units that no column has.
void note_units(const IsoSource& source, std::vector<std::string>& notes);

/// Values are positions if the user says so, or if they follow the targets. Then subtracts the
/// targets; displacements are counted from the first reading.
void take_deviations(const TextTable& table, const Facts& facts, const IsoQuantities& quantities,
                     std::vector<IsoPoint>& points, std::vector<std::string>& notes);

}  // namespace trunnion::imports

// Reads what the programs of the four-function test print by DPRNT.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "pivot/pivot_maps.h"

namespace trunnion::pivot {

/// What one call was given: prints of one run of each function.
struct PivotPrints {
    std::vector<PivotMap> maps;
    std::map<std::string, Vector3> spheres_mm;  ///< by function: last sphere found at home
    std::optional<Vector3> g54_mm;              ///< with the external offset, as printed
    std::map<int, double> parameters_mm;        ///< 19700.., as printed
    int zeroings = 0;
    std::string date;  ///< of the measurement, "2024-03-12", of several days "first to last";
                       ///< empty: not told

    Vector3 sphere_mm() const;  ///< mean of those found
};

struct PrintedFile {
    std::string path, text;
};

/// Lines in any order of the files:
///     PIVOT RTCP AXES B C MAPS 1 TO 4      head of a run
///     STORE G54 X.. Y.. Z..   STORE N19700 V..   STORE INCH 0   STORE DATE V20240312
///     RTCP ZERO1 X.. Y.. Z..               sphere found at home before map 1
///     RTCP MAP1 B.. C.. X.. Y.. Z..        found minus expected centre
///     RTCP END
/// Other lines are not for this test. Throws InputError with file, line and text: no such lines,
/// axes that the control does not have, a function that stands twice, a run without END, a map or
/// an indexation that is missing, stores that changed between two programs, values that are no mm.
PivotPrints parse_pivot_prints(const std::vector<PrintedFile>& files, Axis first, Axis second);

/// Stores in force: `declared`, with what was printed in their place; one note for each number that
/// differs.
setup::RotaryStores stores_in_force(const PivotPrints& prints, const setup::RotaryStores& declared,
                                    std::vector<std::string>& notes);

}  // namespace trunnion::pivot

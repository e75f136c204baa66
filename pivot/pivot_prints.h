// Reads the DPRNT output of the four-function test programs.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "pivot/pivot_maps.h"

namespace trunnion::pivot {

/// Content of the files of one call: one run of each function.
struct PivotPrints {
    std::vector<PivotMap> maps;
    std::map<std::string, Vector3> spheres_mm;  ///< by function: last sphere measured at home
    std::optional<Vector3> g54_mm;              ///< including the external offset, as printed
    std::map<int, double> parameters_mm;        ///< 19700.., as printed
    std::map<int, double> lengths_mm;           ///< of the probe, by offset number, as printed
    int zeroings = 0;
    std::string date;  ///< of the measurement, "2024-03-12"; several days: "first to last"; empty:
                       ///< not given

    Vector3 sphere_mm() const;  ///< mean of those measured
};

struct PrintedFile {
    std::string path, text;
};

/// Lines, with the files in any order:
///     PIVOT RTCP AXES B C MAPS 1 TO 4      head of a run
///     STORE G54 X.. Y.. Z..   STORE N19700 V..   STORE H1 V..   STORE INCH 0
///     STORE DATE V20240312
///     RTCP ZERO1 X.. Y.. Z..               sphere measured at home before map 1
///     RTCP MAP1 B.. C.. X.. Y.. Z..        measured minus expected centre
///     RTCP END
/// Other lines are ignored. Throws InputError with file, line and text: no such lines, axes that
/// the control does not have, a function given twice, a run without END, a missing map or
/// indexation, stores that changed between two programs, values that are not mm.
PivotPrints parse_pivot_prints(const std::vector<PrintedFile>& files, Axis first, Axis second);

/// The active stores: `declared`, replaced by printed values; one note for each value that differs.
setup::RotaryStores stores_in_force(const PivotPrints& prints, const setup::RotaryStores& declared,
                                    std::vector<std::string>& notes);
/// One note for each printed length of the probe that is not the declared one.
void compare_lengths(const PivotPrints& prints, const offsets::ToolOffsets& declared,
                     std::vector<std::string>& notes);

}  // namespace trunnion::pivot

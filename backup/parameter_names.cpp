#include "backup/parameter_names.h"

#include <algorithm>

namespace trunnion::backup {

namespace {

using enum Standing;

constexpr ParameterRow rows[] = {
    {0, 0, obeyed, "units of input (#2)"},
    {1001, 1001, obeyed, "inch machine (#0)"},
    {1006, 1006, known, "rotary axis (#0)"},
    {1008, 1008, obeyed, "roll-over of rotary axes (#0, #1)"},
    {1013, 1013, obeyed, "least increment (#1)"},
    {1020, 1020, obeyed, "names of the axes"},
    {1022, 1022, obeyed, "axis in the basic coordinate system"},
    {1240, 1243, obeyed, "reference positions"},
    {1320, 1320, obeyed, "stored stroke 1, positive end"},
    {1321, 1321, obeyed, "stored stroke 1, negative end"},
    {1401, 1401, known, "rapid traverse (#1: interpolated)"},
    {1420, 1420, obeyed, "rapid traverse speed"},
    {1422, 1422, known, "highest cutting feed"},
    {1430, 1430, known, "highest cutting feed of each axis"},
    {1620, 1621, known, "time constants of rapid traverse"},
    {1783, 1783, obeyed, "allowed change of speed at corners"},
    {1815, 1815, known, "absolute encoder, scale"},
    {1820, 1820, obeyed, "command multiplier (unit of 1851 and of the pitch data)"},
    {1821, 1821, known, "reference counter"},
    {1825, 1825, known, "servo loop gain"},
    {1850, 1850, known, "grid shift"},
    {1851, 1851, obeyed, "backlash compensation"},
    {1852, 1852, known, "backlash compensation at rapid traverse"},
    {3401, 3403, obeyed, "reading of words (#0, 3402, 3403#5 #6)"},
    {3410, 3410, obeyed, "tolerance of arc radii"},
    {3620, 3625, obeyed, "points of the pitch error compensation"},
    {3626, 3627, known, "pitch error compensation by direction"},
    {3770, 3772, obeyed, "constant surface speed"},
    {5001, 5001, obeyed, "kind of tool length compensation (#0, #1)"},
    {5003, 5004, obeyed, "cutter compensation"},
    {5006, 5006, obeyed, "tool length shifts (#6)"},
    {5114, 5115, obeyed, "returns of G73 and G83"},
    {5400, 5400, obeyed, "unit of rotation angles (#0)"},
    {5410, 5410, obeyed, "rotation angle without R"},
    {5440, 5440, obeyed, "overrun of G60"},
    {5460, 5461, obeyed, "axes of G12.1"},
    {6000, 6001, obeyed, "macros (6000#3, 6001#1 #5)"},
    {6004, 6004, obeyed, "range of ATAN and ASIN (#0)"},
    {6050, 6059, obeyed, "G codes that call O9010 to O9019"},
    {6071, 6079, obeyed, "M codes that call O9001 to O9009"},
    {6080, 6089, obeyed, "M codes that call O9020 to O9029"},
    {6200, 6210, known, "skip signal"},
    {6241, 6241, obeyed, "feed of G37"},
    {6251, 6251, obeyed, "distance of G37 at that feed"},
    {6254, 6254, obeyed, "tolerance of G37"},
    {7570, 7570, obeyed, "G54.2 (#0)"},
    {7575, 7575, known, "axes of G54.2"},
    {7580, 7588, obeyed, "rotary axes of G54.2"},
    {10000, 11535, obeyed, "pitch error data"},
    {12321, 12322, obeyed, "vertical axis of G68.3"},
    {19607, 19607, obeyed, "outside corners (#2)"},
    {19625, 19625, obeyed, "blocks read ahead"},
    {19666, 19666, obeyed, "tool holder offset"},
    {19680, 19680, obeyed, "kind of five-axis machine"},
    {19681, 19690, obeyed, "rotary axes of the five-axis machine"},
    {19696, 19696, obeyed, "five-axis switches (#0, #1, #5, #6)"},
    {19697, 19699, obeyed, "direction of the tool"},
    {19700, 19702, obeyed, "place of the first rotary axis of the table"},
    {19703, 19705, obeyed, "first to second rotary axis of the table"},
    {19709, 19711, obeyed, "tool axis to first rotary axis of the head"},
    {19712, 19714, obeyed, "second to first rotary axis of the head"},
    {19741, 19744, obeyed, "travel of the rotary axes in tilted planes"},
};

const ParameterRow* find_row(int number) {
    const auto row = std::find_if(std::begin(rows), std::end(rows), [&](const ParameterRow& r) {
        return number >= r.first && number <= r.last;
    });
    return row == std::end(rows) ? nullptr : row;
}

}  // namespace

std::span<const ParameterRow> parameter_rows() {
    return rows;
}

Standing standing_of_parameter(int number) {
    const ParameterRow* row = find_row(number);
    return row ? row->standing : ignored;
}

std::string name_of_parameter(int number) {
    const ParameterRow* row = find_row(number);
    return row ? row->name : "";
}

}  // namespace trunnion::backup

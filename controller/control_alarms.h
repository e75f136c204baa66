// The control's own alarms: number, text as displayed, cause and remedy.
#pragma once

#include <vector>

namespace trunnion::controller {

struct AlarmRow {
    int number;
    const char* prefix;  ///< "PS", "OT", "MC": displayed before the number
    const char* text;    ///< as displayed
    const char* cause;
    const char* remedy;
};

/// The alarms of the control itself (the language and cutter compensation have their own tables).
const std::vector<AlarmRow>& control_alarms();

}  // namespace trunnion::controller

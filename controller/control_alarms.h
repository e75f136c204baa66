// The control's own alarms: number, text as on the screen, cause and remedy.
#pragma once

#include <vector>

namespace trunnion::controller {

struct AlarmRow {
    int number;
    const char* prefix;  ///< "PS", "OT", "MC": shown before the number
    const char* text;    ///< as on the screen
    const char* cause;
    const char* remedy;
};

/// The rows of the control itself (the language and cutter compensation have their own).
const std::vector<AlarmRow>& control_alarms();

}  // namespace trunnion::controller

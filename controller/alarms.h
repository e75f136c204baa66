// All alarms that a program can meet, and how the control raises one.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/alarm.h"
#include "controller/control_alarms.h"

namespace trunnion::controller {

/// All alarms that a program can meet, rising by number.
const std::vector<AlarmRow>& alarm_table();
/// The row of a number, or nullptr (3000 and above are the program's own).
const AlarmRow* find_alarm(int number);
/// "PS0010 IMPROPER G-CODE", "MC3005 PROBE MISSED".
std::string alarm_title(int number, std::string_view text);

/// Throws the alarm with the table's text; `column` 0 when the place is the whole block.
[[noreturn]] void raise_alarm(int number, int column = 0);
/// The same with words of one's own behind the text: "+ OVERTRAVEL (SOFT 1) X".
[[noreturn]] void raise_alarm(int number, const std::string& detail, int column = 0);

}  // namespace trunnion::controller

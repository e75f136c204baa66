// All alarms that a program can raise, and the functions that raise them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/alarm.h"
#include "controller/control_alarms.h"

namespace trunnion::controller {

/// All alarms that a program can raise, in ascending order of number.
const std::vector<AlarmRow>& alarm_table();
/// The row of a number, or nullptr (numbers from 3000 on belong to the NC program).
const AlarmRow* find_alarm(int number);
/// "PS0010 IMPROPER G-CODE", "MC3005 PROBE MISSED".
std::string alarm_title(int number, std::string_view text);

/// Throws the alarm with the text of the table; `column` 0: the whole block is at fault.
[[noreturn]] void raise_alarm(int number, int column = 0);
/// The same with additional text: "+ OVERTRAVEL (SOFT 1) X".
[[noreturn]] void raise_alarm(int number, const std::string& detail, int column = 0);
/// PS0010 with the name of an option that this control does not have.
[[noreturn]] void refuse_option(std::string_view option, int column);

}  // namespace trunnion::controller

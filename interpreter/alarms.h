// The alarms of the language as one table: number, displayed text, cause and remedy.
#pragma once

#include <span>
#include <string>

#include "base/alarm.h"

namespace trunnion::interpreter {

struct AlarmInfo {
    int number;
    const char* text;  ///< as displayed, without the number ("PS0112 ZERO DIVIDE" is 112)
    const char* cause;
    const char* remedy;
};

/// In ascending order of number. Spellings of the 30i list, from memory (assumed).
std::span<const AlarmInfo> language_alarms();
/// The row of `number`, or nullptr.
const AlarmInfo* language_alarm(int number);

/// Throws the alarm with the displayed text, then `: detail`, and the column (0: unknown). The
/// caller that runs the block adds line and program.
[[noreturn]] void raise_language_alarm(int number, int column = 0, const std::string& detail = {});

}  // namespace trunnion::interpreter

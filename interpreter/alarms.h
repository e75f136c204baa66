// The alarms of the language: number, screen text, cause and remedy as one table.
#pragma once

#include <span>
#include <string>

#include "base/alarm.h"

namespace trunnion::interpreter {

struct AlarmInfo {
    int number;
    const char* text;  ///< as on the screen, without the number ("PS0112 ZERO DIVIDE" is 112)
    const char* cause;
    const char* remedy;
};

/// Rising by number. Spellings are those of the 30i list from memory (assumed).
std::span<const AlarmInfo> language_alarms();
/// The row of `number`, or nullptr.
const AlarmInfo* language_alarm(int number);

/// Throws the alarm with the screen text, `: detail` behind it, and the column (0: not known). The
/// line and the program are filled in by whoever runs the block.
[[noreturn]] void raise_language_alarm(int number, int column = 0, const std::string& detail = {});

}  // namespace trunnion::interpreter

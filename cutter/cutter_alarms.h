// The alarms of cutter compensation, chamfers and corner radii.
#pragma once

#include <span>

#include "base/alarm.h"
#include "motion/block_marks.h"

namespace trunnion::cutter {

struct CutterAlarm {
    int number;
    const char* text;  ///< as displayed
    const char* cause;
    const char* remedy;
};

std::span<const CutterAlarm> cutter_alarms();
/// Throws the alarm `number` with its text, without a position.
[[noreturn]] void raise_cutter_alarm(int number);
/// Gives an alarm without a position that of the block of the marks.
void place_alarm(Alarm& alarm, const motion::BlockMarks& marks);

}  // namespace trunnion::cutter

// The alarms of cutter compensation and of corners between sides.
#pragma once

#include <span>

#include "base/alarm.h"
#include "motion/block_marks.h"

namespace trunnion::cutter {

struct CutterAlarm {
    int number;
    const char* text;  ///< as on the screen
    const char* cause;
    const char* remedy;
};

std::span<const CutterAlarm> cutter_alarms();
/// Throws the alarm of that number with its text and without a place.
[[noreturn]] void raise_cutter_alarm(int number);
/// An alarm without a place gets that of the block that the marks belong to.
void place_alarm(Alarm& alarm, const motion::BlockMarks& marks);

}  // namespace trunnion::cutter

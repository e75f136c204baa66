#include "cutter/cutter_alarms.h"

#include <algorithm>
#include <stdexcept>

namespace trunnion::cutter {

namespace {

constexpr CutterAlarm rows[] = {
    {33, "NO INTERSECTION AT CUTTER COMPENSATION", "Two compensated paths do not meet.",
     "Change the path or the radius."},
    {34, "NO CIRC ALLOWED IN STUP/EXT BLK", "G41, G42 or G40 in a G2 or G3 block.",
     "Start and end compensation on G0 or G1."},
    {38, "INTERFERENCE IN CIRCULAR BLOCK", "An arc has its centre in the cut under compensation.",
     "Make the arc larger than the cutter."},
    {41, "INTERFERENCE IN CUTTER COMPENSATION", "The cutter would cut into the contour.",
     "Use a smaller cutter or change the contour."},
    {51, "MISSING MOVE AFTER CNR/CHF", "No move in the plane follows a chamfer or corner R.",
     "Program the next side."},
    {52, "CODE IS NOT G01 AFTER CHF/CNR", "The block after a chamfer or corner R is no G1, G2, G3.",
     "Correct the next block."},
    {55, "MISSING MOVE VALUE IN CHF/CNR", "A side is shorter than the chamfer or corner R.",
     "Make the corner smaller."},
};

}  // namespace

std::span<const CutterAlarm> cutter_alarms() {
    return rows;
}

void raise_cutter_alarm(int number) {
    const auto* const row = std::find_if(std::begin(rows), std::end(rows),
                                         [&](const CutterAlarm& r) { return r.number == number; });
    if (row == std::end(rows)) throw std::logic_error("no such alarm of cutter compensation");
    throw Alarm(number, row->text);
}

void place_alarm(Alarm& alarm, const motion::BlockMarks& marks) {
    if (alarm.where.line != 0) return;
    if (marks.program) alarm.where.program = *marks.program;
    alarm.where.line = marks.line;
    alarm.where.column = 1;  // the words at hand belong to a later block
}

}  // namespace trunnion::cutter

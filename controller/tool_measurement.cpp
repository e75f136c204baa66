#include "controller/tool_measurement.h"

#include <cmath>
#include <utility>

#include "controller/alarms.h"
#include "controller/commanded.h"

namespace trunnion::controller {

namespace {

/// The only axis of the block.
Axis measured_axis(const SortedWords& words, const Modal& modal) {
    std::optional<Axis> axis;
    for (const ControlAxis& entry : modal.settings.axes) {
        if (!words.has(entry.axis)) continue;
        if (axis || entry.rotary) raise_alarm(83, words.column_of(letter_of(entry.axis)));
        axis = entry.axis;
    }
    if (!axis || !modal.absolute()) raise_alarm(83);
    return *axis;
}

void check_state(const SortedWords& words, const Modal& modal, const Frames& frames) {
    if (!modal.cutter_is_off() || modal.is(ModalGroup::length, 440) || frames.tip.in_force)
        raise_alarm(9005);
    if (words.has('H')) raise_alarm(82, words.column_of('H'));
    if (modal.number.length == 0) raise_alarm(81);
    if (modal.settings.measuring.feed_mm_min <= 0.0) raise_alarm(11, "(6241)");
}

/// The last part of the way, at the measuring feed.
bool touch_setter(const offsets::ControlPosition& beyond, Modal& modal, Mover& mover) {
    motion::FeedState slow = modal.block.feed;
    slow.inverse_time = false;
    slow.mm_min = modal.settings.measuring.feed_mm_min;
    slow.seconds_per_mm = 60.0 / slow.mm_min;
    const motion::FeedState feed = std::exchange(modal.block.feed, slow);
    mover.axes.until_skip(true);
    const bool touched = mover.line(motion::MotionKind::linear, beyond).skipped;
    mover.axes.until_skip(false);
    modal.block.feed = feed;
    return touched;
}

}  // namespace

void measure_tool_length(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover) {
    check_state(words, modal, frames);
    const Axis axis = measured_axis(words, modal);
    const ToolMeasuring& rule = modal.settings.measuring;
    const offsets::ControlPosition setter = commanded_position(words, modal, frames);
    const double way = setter[axis] - frames.program[axis];
    const double sense = std::copysign(1.0, way);
    offsets::ControlPosition before = setter, beyond = setter;
    before[axis] -= sense * rule.slow_mm;
    beyond[axis] += sense * rule.tolerance_mm;
    if (std::abs(way) > rule.slow_mm) mover.line(motion::MotionKind::rapid, before);
    const bool touched = touch_setter(beyond, modal, mover);
    const double longer_mm = frames.program[axis] - setter[axis];
    if (!touched || std::abs(longer_mm) > rule.tolerance_mm) raise_alarm(80);
    frames.stores().tools.tool[static_cast<std::size_t>(modal.number.length)].length_wear_mm +=
        longer_mm;
}

}  // namespace trunnion::controller

#include "controller/reference_points.h"

#include "controller/alarms.h"
#include "controller/commanded.h"

namespace trunnion::controller {

namespace {

/// 1 for G28; P of G30, default 2.
int reference_number(const SortedWords& words, int code10) {
    if (code10 == 280) return 1;
    return words.has('P') ? words.whole('P') : 2;
}

void no_cycle(const Modal& modal) {
    if (modal.in_cycle()) raise_alarm(44);
}

}  // namespace

void ReferencePoints::go(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover,
                         int code10) {
    no_cycle(modal);
    const auto& point =
        modal.settings.reference[static_cast<std::size_t>(reference_number(words, code10) - 1)];
    const offsets::ControlPosition through = commanded_position(words, modal, frames);
    mover.line(motion::MotionKind::rapid, through);
    offsets::ControlPosition target = frames.machine;
    for (const ControlAxis& entry : modal.settings.axes) {
        if (!words.has(entry.axis)) continue;
        intermediate_[entry.axis] = through[entry.axis];
        target[entry.axis] = point[index_of(entry.axis)];
    }
    mover.axes.to_machine(motion::MotionKind::rapid, target);
    frames.length_parked = true;
}

void ReferencePoints::come_back(const SortedWords& words, Modal& modal, Frames& frames,
                                Mover& mover) {
    no_cycle(modal);
    offsets::ControlPosition through = frames.program;
    for (const ControlAxis& entry : modal.settings.axes)
        if (words.has(entry.axis)) through[entry.axis] = intermediate_[entry.axis];
    mover.line(motion::MotionKind::rapid, through);
    mover.line(motion::MotionKind::rapid, commanded_position(words, modal, frames));
}

void check_reference(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover) {
    no_cycle(modal);
    mover.line(motion::MotionKind::rapid, commanded_position(words, modal, frames));
    constexpr double in_position = 0.001;  // mm or deg
    for (const ControlAxis& entry : modal.settings.axes) {
        if (!words.has(entry.axis)) continue;
        const double off =
            frames.machine[entry.axis] - modal.settings.reference[0][index_of(entry.axis)];
        if (off > in_position || off < -in_position)
            raise_alarm(92, std::string(1, letter_of(entry.axis)),
                        words.column_of(letter_of(entry.axis)));
    }
}

}  // namespace trunnion::controller

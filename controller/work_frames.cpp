#include "controller/work_frames.h"

#include <fmt/format.h>

#include "controller/alarms.h"
#include "controller/commanded.h"

namespace trunnion::controller {

void work_offset_changed(const Modal& modal, Frames& frames, Mover& mover) {
    frames.take_work_offset(modal);
    mover.frames_changed();
}

void set_work_offset(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover,
                     int code10) {
    if (frames.tip.in_force) raise_alarm(5421, "(a work offset under it)");
    const bool additional = code10 == 541 || (code10 == 540 && words.has('P') && !words.has('L'));
    int number = 0;
    if (additional) {
        const int most = static_cast<int>(frames.stores().work.additional.size());
        number = words.whole('P');
        if (number < 1 || number > most)
            raise_alarm(30, fmt::format("(G54.1: P is 1 to {})", most), words.column_of('P'));
    }
    modal.number.work = number;
    modal.codes.set(ModalGroup::work_offset, additional ? 541 : code10);
    work_offset_changed(modal, frames, mover);
}

void set_local_shift(const SortedWords& words, const Modal& modal, Frames& frames, Mover& mover) {
    for (const ControlAxis& entry : modal.settings.axes)
        if (words.has(entry.axis)) frames.stages.local[entry.axis] = words.axis_value(entry.axis);
    mover.frames_changed();
}

namespace {

/// G53 under G91 "is ignored" (Fanuc, from memory), which a reader can take for the block or for
/// the code alone; a Mitsubishi M700V moves incrementally (manual p. 508).
void without_g53(const SortedWords& words, Modal& modal, const Frames& frames, Mover& mover) {
    if (!words.has_axis()) return;
    if (!modal.settings.g53_under_g91_moves)
        return mover.note(
            "G53 under G91 is ignored and nothing moves; with g53_under_g91_moves = true the "
            "words move incrementally");
    mover.line(
        modal.is(ModalGroup::motion, 0) ? motion::MotionKind::rapid : motion::MotionKind::linear,
        commanded_position(words, modal, frames));
}

}  // namespace

void go_to_machine_position(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover) {
    // A public post cancels the plane first because the control asks for it.
    if (modal.settings.is_hurco() && frames.stages.feature_MF)
        raise_alarm(9003, "(G53 in a plane: G69 first)");
    if (!modal.absolute()) return without_g53(words, modal, frames, mover);
    offsets::ControlPosition target = frames.machine;
    for (const ControlAxis& entry : modal.settings.axes)
        if (words.has(entry.axis)) target[entry.axis] = words.axis_value(entry.axis);
    mover.axes.to_machine(motion::MotionKind::rapid, target);
    frames.length_parked = true;
}

void preset_position(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover) {
    if (words.has('S')) modal.spindle.most_rpm = words.get('S');
    Coordinates& stages = frames.stages;
    offsets::ControlPosition wanted = frames.program;
    for (const ControlAxis& entry : modal.settings.axes)
        if (words.has(entry.axis))
            wanted[entry.axis] = words.axis_value(entry.axis);  // absolute under G91 too
    const offsets::ControlPosition from = stages.shaped_from_program(frames.program);
    const offsets::ControlPosition to = stages.shaped_from_program(wanted);
    for (const ControlAxis& entry : modal.settings.axes) {
        const Axis axis = entry.axis;
        const bool in_plane = stages.feature_MF && index_of(axis) < 3;
        (in_plane ? stages.local : stages.preset)[axis] += from[axis] - to[axis];
        if (in_plane || !words.has(axis)) continue;
        stages.preset[axis] += stages.local[axis];
        stages.local[axis] = 0.0;
    }
    mover.frames_changed();
}

void cancel_preset(const SortedWords& words, const Modal& modal, Frames& frames, Mover& mover) {
    for (const ControlAxis& entry : modal.settings.axes) {
        if (!words.has(entry.axis)) continue;
        frames.stages.preset[entry.axis] = 0.0;
        frames.stages.local[entry.axis] = 0.0;
    }
    mover.frames_changed();
}

}  // namespace trunnion::controller

#include "controller/tool_length.h"

#include "controller/alarms.h"

namespace trunnion::controller {

namespace {

Axis length_axis(const SortedWords& words, const Modal& modal) {
    const ControlSettings& settings = modal.settings;
    if (settings.length_axis_type == 0) return Axis::Z;
    if (settings.length_axis_type == 1) return modal.plane().normal;
    for (const ControlAxis& entry : settings.axes)  // type C: the axis named in the block
        if (words.has(entry.axis)) return entry.axis;
    raise_alarm(27);
}

/// The length of types A to C acts along one axis, which may be other than X, Y or Z.
offsets::ControlPosition length_along(Axis axis, double length_mm) {
    offsets::ControlPosition out;
    out[axis] = length_mm;
    return out;
}

/// Shift type, or length removed at the reference position: the position display changes. Otherwise
/// the program position is kept and the axis moves to it.
void put_in_force(const offsets::ControlPosition& length, const Modal& modal, Frames& frames,
                  Mover& mover) {
    const offsets::ControlPosition program = frames.program;
    const bool parked = frames.length_parked;
    frames.stages.length = frames.staged_length(length);
    mover.frames_changed();
    if (modal.settings.length_shifts || parked) return;
    frames.program = program;
    frames.length_moves = true;
}

}  // namespace

double tool_length_mm(const SortedWords& words, const offsets::ToolOffsets& tools, int number) {
    if (number >= static_cast<int>(tools.tool.size())) raise_alarm(30, words.column_of('H'));
    return number == 0 ? 0.0 : tools.tool[static_cast<std::size_t>(number)].length_mm();
}

void watch_length(const SortedWords& words, const Modal& modal, const Frames& frames,
                  Mover& mover) {
    const int number = modal.number.length;
    if (number == 0) {
        if (!words.has('H'))
            mover.caution(
                {.kind = CautionKind::no_offset, .line = modal.block.line, .letter = 'H'});
        return;
    }
    const offsets::ToolOffset& tool = frames.stores().tools.tool[static_cast<std::size_t>(number)];
    if (tool.length_mm() == 0.0 && !tool.length_given)
        mover.caution({.kind = CautionKind::unset_offset,
                       .line = modal.block.line,
                       .letter = 'H',
                       .number = number});
}

void apply_tool_length(const ToolVector& tool, const Modal& modal, Frames& frames, Mover& mover) {
    frames.tool = tool;
    offsets::ControlPosition length;
    offsets::set_xyz(length, tool.vector_mm);
    put_in_force(length, modal, frames, mover);
}

void cancel_tool_centre(Frames& frames, Mover& mover) {
    if (!frames.tip.in_force) return;
    frames.tip.in_force.reset();
    mover.frames_changed();
}

void set_tool_length(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover,
                     int code10) {
    const bool hurco = modal.settings.is_hurco();
    const bool from_tcp = frames.tip.in_force.has_value();
    if (!hurco) cancel_tool_centre(frames, mover);
    modal.codes.set(ModalGroup::length, code10);
    if (words.has('H')) modal.number.length = words.whole('H');
    const bool on = code10 != 490 || (hurco && modal.settings.hurco.g49_keeps_tool_length);
    offsets::ControlPosition length;
    if (on) {
        const double sign = code10 == 440 ? -1.0 : 1.0;
        length =
            length_along(length_axis(words, modal),
                         sign * tool_length_mm(words, frames.stores().tools, modal.number.length));
        watch_length(words, modal, frames, mover);
    }
    frames.tool = {offsets::xyz_of(length), on ? modal.number.length : 0};
    if (frames.tip.in_force) frames.tip.in_force->tool_vector_mm = frames.tool.vector_mm;
    put_in_force(length, modal, frames, mover);
    if (!from_tcp || on) return;
    frames.length_moves = false;
    mover.frames_changed();
}

}  // namespace trunnion::controller

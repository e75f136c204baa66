#include "controller/tool_centre.h"

#include "controller/alarms.h"
#include "controller/tool_length.h"

namespace trunnion {

namespace {

ToolVector along_tool(const SortedWords& words, const Modal& modal, const Frames& frames,
                      const RotaryTransform& transform) {
    const double length_mm = tool_length_mm(words, frames.stores().tools, modal.number.length);
    return {length_mm * transform.pivot().tool_direction, modal.number.length};
}

}  // namespace

void start_tool_centre(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover,
                       const GCode& code) {
    const RotaryTransform& transform = frames.transform(5420);
    const bool by_vector = code.code10 == 435;
    if (by_vector && transform.pivot().frame_follows_work)
        raise_alarm(5459, "(G43.5 with WKP, 19696#5)");
    if (frames.fixture_number != 0) raise_alarm(5421, "(G54.2 is in force)");
    if (!modal.cutter_is_off()) raise_alarm(5421, "(cutter compensation is in force)");
    if (words.has('H')) modal.number.length = words.whole('H');
    cancel_tool_centre(frames, mover);
    const ToolVector tool = along_tool(words, modal, frames, transform);
    modal.codes.set(ModalGroup::length, code.code10);
    apply_tool_length(tool, modal, frames, mover);
    frames.tip.by_vector = by_vector;
    frames.tip.lean_rad = by_vector ? rad_from_deg(words.get('Q', 0.0)) : 0.0;
    frames.tip.starting =
        ToolCentrePoint::start(transform, frames.axes, modal.settings.tcp_frame, tool.vector_mm);
}

void take_over_tool_centre(const SortedWords& words, Frames& frames, Mover& mover) {
    if (!frames.tip.starting) return;
    frames.tip.in_force = frames.tip.starting;
    frames.tip.starting.reset();
    mover.frames_changed();
    if (frames.tip.by_vector && (words.present & tool_vector_letters))
        mover.line(MotionKind::rapid, frames.program);
}

void change_length_number(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover) {
    const int present = modal.codes[ModalGroup::length];
    if (present == 430 || present == 440)
        return set_tool_length(words, modal, frames, mover, present);
    modal.number.length = words.whole('H');
    if (!frames.tip.in_force) return;
    ToolCentrePoint& tcp = *frames.tip.in_force;
    const ToolVector tool = along_tool(words, modal, frames, *tcp.transform);
    tcp.tool_vector_mm = tool.vector_mm;
    apply_tool_length(tool, modal, frames, mover);
}

}  // namespace trunnion

#include "controller/tool_centre.h"

#include <fmt/format.h>

#include "controller/alarms.h"
#include "controller/tool_length.h"

namespace trunnion::controller {

namespace {

ToolVector along_tool(const SortedWords& words, const Modal& modal, const Frames& frames,
                      const positioning::RotaryTransform& transform) {
    const double length_mm = tool_length_mm(words, frames.stores().tools, modal.number.length);
    return {length_mm * transform.pivot().tool_direction, modal.number.length};
}

std::string point_text(const Vector3& p) {
    return fmt::format("X{:.3f} Y{:.3f} Z{:.3f}", p.x() + 0.0, p.y() + 0.0, p.z() + 0.0);
}

/// The programmed origin on the table by either frame. Returns their distance, mm; 0 within
/// rounding.
double note_frames(const Modal& modal, const Frames& frames, Mover& mover) {
    const positioning::RotaryTransform& transform = *frames.tip.starting->transform;
    const Vector3 tip_M = offsets::xyz_of(frames.stages.machine_from_program(frames.program)) -
                          offsets::xyz_of(frames.stages.length);
    const Vector3 origin = frames.origin_of_work();
    const Vector3 start = transform.pose_MW(frames.axes).inverse() * tip_M - origin;
    const Vector3 rotary_zero = tip_M - origin;
    const double apart_mm = (start - rotary_zero).norm();
    if (apart_mm < 1e-6) return 0.0;
    const char* const code = frames.tip.by_vector ? "G43.5" : "G43.4";
    const std::string text = fmt::format(
        "starts with the table off zero: on the table the programmed point is {} with tcp_frame = "
        "\"start\" and {} with \"rotary_zero\"; in force is \"{}\"",
        point_text(start), point_text(rotary_zero),
        modal.settings.tcp_frame == positioning::TcpFrame::start ? "start" : "rotary_zero");
    if (mover.record().notes.size() < 200)
        mover.note(fmt::format("{} line {} {}", code, modal.block.line, text));
    if (modal.block.program && mover.record().turned_starts.size() < 200)
        mover.record().add({*modal.block.program, modal.block.line, code + (' ' + text)});
    return apart_mm;
}

}  // namespace

void start_tool_centre(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover,
                       const GCode& code) {
    const positioning::RotaryTransform& transform = frames.transform(5420);
    const bool by_vector = code.code10 == 435;
    if (by_vector && transform.pivot().frame_follows_work)
        raise_alarm(5459, "(G43.5 with WKP, 19696#5)");
    if (frames.fixture_number != 0) raise_alarm(5421, "(G54.2 is in force)");
    if (!modal.cutter_is_off()) raise_alarm(5421, "(cutter compensation is in force)");
    if (words.has('H')) modal.number.length = words.whole('H');
    cancel_tool_centre(frames, mover);
    const ToolVector tool = along_tool(words, modal, frames, transform);
    watch_length(words, modal, frames, mover);
    modal.codes.set(ModalGroup::length, code.code10);
    apply_tool_length(tool, modal, frames, mover);
    frames.tip.by_vector = by_vector;
    frames.tip.lean_rad = by_vector ? rad_from_deg(words.get('Q', 0.0)) : 0.0;
    frames.tip.starting = motion::ToolCentrePoint::start(transform, frames.axes,
                                                         modal.settings.tcp_frame, tool.vector_mm);
}

void take_over_tool_centre(const SortedWords& words, const Modal& modal, Frames& frames,
                           Mover& mover) {
    if (!frames.tip.starting) return;
    const offsets::ControlPosition programmed = frames.program;
    const double apart_mm = note_frames(modal, frames, mover);
    frames.tip.in_force = frames.tip.starting;
    frames.tip.starting.reset();
    mover.frames_changed();
    const bool other_frame =
        modal.settings.tcp_frame == positioning::TcpFrame::rotary_zero && apart_mm > 0.0;
    if (other_frame && !words.has_axis() && !frames.tip.in_force->follows_work) {
        offsets::set_xyz(frames.program, offsets::xyz_of(programmed));
        frames.tip.keeps_program = true;
    }
    if (frames.tip.by_vector && (words.present & tool_vector_letters))
        mover.line(motion::MotionKind::rapid, frames.program);
}

void change_length_number(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover) {
    const int present = modal.codes[ModalGroup::length];
    if (present == 430 || present == 440)
        return set_tool_length(words, modal, frames, mover, present);
    modal.number.length = words.whole('H');
    if (!frames.tip.in_force) return;
    motion::ToolCentrePoint& tcp = *frames.tip.in_force;
    const ToolVector tool = along_tool(words, modal, frames, *tcp.transform);
    watch_length(words, modal, frames, mover);
    tcp.tool_vector_mm = tool.vector_mm;
    apply_tool_length(tool, modal, frames, mover);
}

}  // namespace trunnion::controller

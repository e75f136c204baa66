#include "controller/cutter_codes.h"

#include <algorithm>

#include "controller/alarms.h"
#include "controller/arcs.h"
#include "controller/commanded.h"

namespace trunnion::controller {

namespace {

bool is_round(const Modal& modal) {
    return modal.is(ModalGroup::motion, 20) || modal.is(ModalGroup::motion, 30);
}

/// Active cutter radius, signed: + left of the path (G41), - right of it (G42).
double offset_mm(const Modal& modal, const Frames& frames) {
    if (modal.cutter_is_off()) return 0.0;
    const auto number = static_cast<std::size_t>(modal.number.radius);
    const double radius = frames.stores().tools.tool[number].radius_mm();
    const double value = modal.settings.radius_is_diameter ? 0.5 * radius : radius;
    const auto& scaling = frames.stages.scaling;
    const double scale = scaling ? scaling->factor[modal.plane().first] : 1.0;
    return (modal.is(ModalGroup::cutter, 410) ? value : -value) / scale;
}

/// The straight move of this block to `target`.
cutter::PathMove straight_move(const SortedWords& words, const Modal& modal, const Frames& frames,
                               const offsets::ControlPosition& target) {
    cutter::PathMove m;
    m.axes = modal.plane();
    m.plane.start = {frames.program[m.axes.first], frames.program[m.axes.second]};
    m.plane.end = {target[m.axes.first], target[m.axes.second]};
    m.to = target;
    m.rapid = modal.is(ModalGroup::motion, 0);
    m.offset_mm = offset_mm(modal, frames);
    m.chamfer = words.corner_chamfer;
    m.round = words.corner_radius;
    m.corner_mm = words.corner;
    m.marks = modal.block;
    return m;
}

/// Type C, G40 alone in its block: the tool shifts back to the programmed point.
cutter::PathMove shift_back(const SortedWords& words, const Modal& modal, const Frames& frames) {
    cutter::PathMove back = straight_move(words, modal, frames, frames.program);
    back.offset_mm = 0.0;
    return back;
}

/// G41 with I, J and K shifts the tool along that vector; without one of them the cutter is
/// compensated in the plane (B-62764EN/01, three-dimensional tool compensation).
void refuse_vector_in_space(const SortedWords& words, const Modal& modal) {
    const bool all = words.has('I') && words.has('J') && words.has('K');
    if (!all || modal.settings.is_hurco() || is_round(modal)) return;
    refuse_option("three-dimensional tool compensation, G41 or G42 with I J K",
                  words.column_of('I'));
}

/// True for one-shot codes that neither move nor change frames.
bool keeps_path(const SortedWords& words, Action action) {
    if (action == Action::data_setting) {
        const double l = words.get('L', 10.0);
        return l >= 10.0 && l <= 13.0;
    }
    return action == Action::dwell || action == Action::accepted || action == Action::builder ||
           action == Action::corner_arc;
}

}  // namespace

void take_radius_number(const SortedWords& words, Modal& modal, const Frames& frames) {
    if (!words.has('D')) return;
    const int number = words.whole('D');
    const int offsets = static_cast<int>(frames.stores().tools.tool.size());
    if (number >= offsets) raise_alarm(30, words.column_of('D'));
    modal.number.radius = number;
}

void watch_radius(const SortedWords& words, const Modal& modal, const Frames& frames,
                  Mover& mover) {
    const int number = modal.number.radius;
    if (number == 0) {
        if (!words.has('D'))
            mover.caution(
                {.kind = CautionKind::no_offset, .line = modal.block.line, .letter = 'D'});
        return;
    }
    const offsets::ToolOffset& tool = frames.stores().tools.tool[static_cast<std::size_t>(number)];
    if (tool.radius_mm() == 0.0 && !tool.radius_given)
        mover.caution({.kind = CautionKind::unset_offset,
                       .line = modal.block.line,
                       .letter = 'D',
                       .number = number});
}

void set_cutter(const SortedWords& words, Modal& modal, const Frames& frames, Mover& mover,
                int code10) {
    refuse_vector_in_space(words, modal);
    const bool on = code10 != 400, alone = !words.has_axis();
    const bool changes = modal.cutter_is_off() == on;
    if (is_round(modal) && changes && !alone) raise_alarm(34);
    if (on) {
        watch_radius(words, modal, frames, mover);
        mover.cutter.start(frames.program, alone);
    } else {
        std::optional<cutter::PathMove> back;
        if (alone && changes && modal.settings.cutter.startup_type_c)
            back = shift_back(words, modal, frames);
        mover.cutter.end(back);
    }
    modal.codes.set(ModalGroup::cutter, code10);
}

void corner_arc(const SortedWords& words, const Modal& modal, Mover& mover) {
    if (modal.cutter_is_off() || words.has_axis()) raise_alarm(10);
    const motion::PlaneAxes& plane = modal.plane();
    PlanePoint to;
    if (words.has(plane.centre_first)) to.x = words.length_mm(plane.centre_first);
    if (words.has(plane.centre_second)) to.y = words.length_mm(plane.centre_second);
    if (!mover.cutter.round_next_corner(to)) mover.note("G39 without a side before it");
}

bool uses_cutter_path(const SortedWords& words, const Mover& mover) {
    return mover.cutter.engaged() || words.corner_radius || words.corner_chamfer;
}

void queue_motion(const SortedWords& words, Modal& modal, const Frames& frames, Mover& mover) {
    const motion::PlaneAxes& plane = modal.plane();
    const bool arc = is_round(modal);
    if (arc) check_arc_words(words, modal);
    if (arc && !has_arc_words(words, plane) && modal.settings.arc_needs_centre) raise_alarm(22);
    cutter::PathMove move =
        straight_move(words, modal, frames, commanded_position(words, modal, frames));
    if (arc && !has_arc_words(words, plane)) watch_straight_arc(words, modal, mover);
    if (arc && has_arc_words(words, plane))
        watch_arc(bend_to_arc(words, plane, arc_rule(modal), move.plane), move.plane, modal, mover);
    mover.queue(move);
}

bool pauses_path(const SortedWords& words) {
    for (std::size_t i = 0; i < words.code_count; ++i) {
        const GCode& code = *words.code[i];
        const bool acts = code.phase == Phase::shot || code.phase == Phase::work_offset ||
                          code.phase == Phase::frame || code.phase == Phase::cycle;
        if (acts && !keeps_path(words, code.action)) return true;
    }
    return false;
}

}  // namespace trunnion::controller

#include "controller/block_execution.h"

#include <cmath>
#include <utility>

#include "controller/alarms.h"
#include "controller/arcs.h"
#include "controller/commanded.h"
#include "controller/cutter_codes.h"
#include "controller/g_actions.h"
#include "controller/position_offset.h"
#include "controller/surface_speed.h"
#include "controller/tool_centre.h"
#include "controller/word_readings.h"
#include "controller/word_sorting.h"

namespace trunnion::controller {

namespace {

constexpr std::uint32_t before_words =
    phase_bit(Phase::speed) | phase_bit(Phase::feed) | phase_bit(Phase::units);

void run_phase(Control& c, Phase phase) {
    SortedWords& w = c.words;
    if (!(w.phases & phase_bit(phase))) return;
    for (std::size_t i = 0; i < w.code_count; ++i) {
        if (w.code[i]->phase != phase) continue;
        w.running_column = w.code_column[i];
        carry_out(c, *w.code[i]);
    }
    w.running_column = 0;
}

/// G92 S_ limits the speed of G96; S is then not a spindle command.
void feed_speed_tool(const SortedWords& w, Modal& modal, const offsets::ControlPosition& program) {
    modal.block.feed.in_block = w.has('F');
    constexpr std::uint32_t fst =
        SortedWords::bit('F') | SortedWords::bit('S') | SortedWords::bit('T');
    if (!(w.present & fst)) return;
    if (w.has('F')) modal.block.feed.programmed = w.get('F') * feed_word_unit(w, modal);
    if (w.has('S') && !w.has_code(920)) take_s_word(modal, w.get('S'), program);
    if (w.has('F') || w.has('S')) modal.feed_changed();
    if (w.has('T')) modal.number.tool = w.whole('T');
}

void note_bare_words(const SortedWords& w, Modal& modal, Mover& mover) {
    if (!modal.settings.bare_is_noted || !(w.bare & SortedWords::axis_letters)) return;
    for (const ControlAxis& axis : modal.settings.axes) {
        const char letter = letter_of(axis.axis);
        if (!w.has(letter) || !w.is_bare(letter) || w.get(letter) == 0.0) continue;
        mover.caution({.kind = CautionKind::bare_words, .line = modal.block.line});
        modal.settings.bare_is_noted = false;
        return;
    }
}

/// G33: F is the lead in every feed mode. PS0011 without F or with the spindle stopped.
void cut_thread(const SortedWords& w, Modal& modal, const Frames& frames, Mover& mover) {
    const double lead_mm = modal.block.feed.programmed * modal.units.unit_mm;
    const double mm_min = lead_mm * std::abs(modal.spindle.signed_rpm());
    if (mm_min <= 0.0) raise_alarm(11, w.column_of('F'));
    motion::FeedState thread = modal.block.feed;
    thread.inverse_time = false;
    thread.mm_min = mm_min;
    thread.seconds_per_mm = 60.0 / mm_min;
    const motion::FeedState feed = std::exchange(modal.block.feed, thread);
    mover.line(motion::MotionKind::linear, commanded_position(w, modal, frames));
    modal.block.feed = feed;
}

/// On a Hurco I J K of a line are the tool's direction, which only M128 leads.
void require_tip_control(const SortedWords& w, const Modal& modal, const Frames& frames) {
    const int code = modal.codes[ModalGroup::motion];
    if (modal.settings.is_hurco() && !frames.tip.in_force && (code == 0 || code == 10) &&
        (w.present & tool_vector_letters))
        raise_alarm(5421, "(I J K without M128)", w.column_of_first(tool_vector_letters));
}

void run_motion(Control& c) {
    SortedWords& w = c.words;
    if (c.modal.in_cycle()) return run_cycle(c.cycle, w, c.modal, c.frames, c.mover);
    require_tip_control(w, c.modal, c.frames);
    c.moved = true;
    if (c.wrapped.polar()) return c.wrapped.move_polar(w, c.modal, c.frames, c.mover);
    if (uses_cutter_path(w, c.mover)) return queue_motion(w, c.modal, c.frames, c.mover);
    const int code = c.modal.codes[ModalGroup::motion];
    if (code == 330) return cut_thread(w, c.modal, c.frames, c.mover);
    if (code == 24 || code == 34) return c.arc_3d.move(w, c.modal, c.frames, c.mover);
    const bool round = code == 20 || code == 30;
    if (c.wrapped.cylinder() && round)
        return c.wrapped.move_cylinder_arc(w, c.modal, c.frames, c.mover);
    if (c.wrapped.cylinder() && code == 10)
        return c.wrapped.move_cylinder_line(w, c.modal, c.frames, c.mover);
    if (round) return move_arc_block(w, c.modal, c.frames, c.mover);
    c.mover.line(code == 0 ? motion::MotionKind::rapid : motion::MotionKind::linear,
                 end_of_straight_move(w, c.modal, c.frames));
}

/// True when the block moves without an axis word: an arc with only its centre is a full circle,
/// G43.5 can turn the tool alone, and R alone makes a hole in a canned cycle.
bool moves_by_itself(const SortedWords& w, const Modal& modal, const Frames& frames) {
    if (frames.length_moves || (w.has('R') && modal.in_cycle())) return true;
    const int code = modal.codes[ModalGroup::motion];
    if (leads_tool(w, modal, frames.tip)) return true;
    return (code == 20 || code == 30) && (w.present & tool_vector_letters);
}

/// True when the block has H without a code that uses it.
bool h_alone(const SortedWords& w) {
    if (!w.has('H')) return false;
    for (std::size_t i = 0; i < w.code_count; ++i)
        if (w.code[i]->group == ModalGroup::length || w.code[i]->group == ModalGroup::one_shot ||
            w.code[i]->group == ModalGroup::cutter)
            return false;
    return true;
}

/// True when the axis words are those of a code of the builder's profile.
bool words_of_builder(const SortedWords& w) {
    if (w.motion) return false;
    for (std::size_t i = 0; i < w.code_count; ++i)
        if (w.code[i]->action == Action::builder) return true;
    return false;
}

void set_motion_code(const SortedWords& w, Modal& modal) {
    if (!w.motion) return;
    modal.codes.set(ModalGroup::motion, w.motion->code10);
    modal.codes.set(ModalGroup::cycle, 800);
}

void take_numbers(Control& c) {
    if (words_of_builder(c.words)) return;
    take_radius_number(c.words, c.modal, c.frames);
    if (c.words.has('D') && !c.modal.cutter_is_off())
        watch_radius(c.words, c.modal, c.frames, c.mover);
}

/// Everything that acts before the motion of the block.
void prepare(Control& c) {
    SortedWords& w = c.words;
    if (w.phases & before_words) {
        for (const Phase phase : {Phase::speed, Phase::feed, Phase::units}) run_phase(c, phase);
        w.units = c.modal.units;
    }
    if (w.bare) note_bare_words(w, c.modal, c.mover);
    feed_speed_tool(w, c.modal, c.frames.program);
    if (w.m_count) c.m_codes.run(false, w, c.modal, c.frames, c.mover);
    take_numbers(c);
    set_motion_code(w, c.modal);
}

/// Executes the codes, then the one-shot code or the motion.
void act(Control& c) {
    const SortedWords& w = c.words;
    if (w.phases)
        for (const Phase phase : {Phase::plane, Phase::reading, Phase::work_offset, Phase::frame,
                                  Phase::offsets, Phase::cycle})
            run_phase(c, phase);
    if (h_alone(w)) change_length_number(w, c.modal, c.frames, c.mover);
    c.modal.block.gap_free = !c.modal.is(ModalGroup::path_mode, 610) && !w.has_code(90);
    if (w.phases & phase_bit(Phase::shot))
        run_phase(c, Phase::shot);
    else if (!words_of_builder(w) && (w.has_axis() || moves_by_itself(w, c.modal, c.frames)))
        run_motion(c);
    c.frames.length_moves = false;
}

/// Tool centre point control starts; frames that depend on the rotary axes are updated.
void follow_rotaries(const SortedWords& w, const Modal& modal, Frames& frames, Mover& mover) {
    take_over_tool_centre(w, modal, frames, mover);
    bool changed = frames.turn_fixture(modal.settings, frames.machine);
    if (frames.plane && !same_rotaries(frames.plane->latched, frames.axes)) {
        frames.place_plane();
        changed = true;
    }
    if (changed) mover.frames_changed();
}

void execute(Control& c, const interpreter::BlockWords& block) {
    sort_words(block, c.modal, c.words);
    c.moved = false;
    c.plane_codes.check_goes_on(c.words);
    c.arc_3d.check_goes_on(c.words);
    if (c.data_entry != DataEntry::none && c.words.code_count == 0) {
        if (c.data_entry == DataEntry::tool_life) return;
        enter_parameter(c.words, block.sequence_number, c.stores.parameters);
        return c.parameters_changed();
    }
    c.modal.block.line = block.line;
    c.modal.block.byte = block.byte;
    prepare(c);
    const offsets::ControlPosition stood = c.frames.machine;
    const bool paused = c.mover.cutter.engaged() && pauses_path(c.words);
    if (paused) c.mover.pause();
    act(c);
    if (c.frames.follows_rotaries() || c.frames.tip.starting)
        follow_rotaries(c.words, c.modal, c.frames, c.mover);
    const bool moved = !(c.frames.machine == stood);
    c.moved = c.moved || moved;
    if (paused) c.mover.resume(moved);
    if (!c.words.m_count) return;
    c.m_codes.run(true, c.words, c.modal, c.frames, c.mover);
    if (c.m_codes.ended()) c.mover.cutter.flush();
}

}  // namespace

void read_block(Control& c, const interpreter::BlockWords& block) {
    sort_words(block, c.modal, c.words);
    c.modal.block.line = block.line;
    if (c.words.bare) note_bare_words(c.words, c.modal, c.mover);
    take_numbers(c);
}

void execute_block(Control& c, const interpreter::BlockWords& block) try {
    execute(c, block);
} catch (Alarm& alarm) {
    const bool of_this_block = alarm.where.line == 0;  // a buffered move reports its own line
    if (of_this_block && alarm.where.column == 0) alarm.where.column = c.words.column_at_fault();
    throw;
}

}  // namespace trunnion::controller

#include "controller/block_execution.h"

#include <bit>
#include <cmath>

#include "controller/arcs.h"
#include "controller/cycles.h"
#include "controller/five_axis.h"
#include "controller/g10.h"
#include "controller/g_codes.h"
#include "controller/g_handlers.h"
#include "controller/m_codes.h"
#include "controller/moves.h"
#include "controller/readings.h"
#include "controller/surface_speed.h"
#include "controller/tool_length.h"
#include "controller/wrapped_motion.h"

namespace trunnion {

namespace {

constexpr std::uint32_t phase_bit(Phase phase) {
    return 1U << static_cast<unsigned>(phase);
}
constexpr std::uint32_t before_words =
    phase_bit(Phase::speed) | phase_bit(Phase::feed) | phase_bit(Phase::units);
/// Addresses that a block may hold besides axes: all but E, N, O.
constexpr std::uint32_t known_letters =
    0x3FFFFFFU & ~(SortedWords::bit('E') | SortedWords::bit('N') | SortedWords::bit('O'));

/// Two codes of one group: the last one counts, or an alarm (3403#6).
void add_code(ControlState& c, const GCode* code, std::uint16_t column) {
    SortedWords& w = c.words;
    if (code->group != ModalGroup::one_shot) {
        for (std::size_t i = 0; i < w.code_count; ++i) {
            if (w.code[i]->group != code->group) continue;
            if (c.settings.duplicates_alarm) raise_alarm(5074, column);
            w.code[i] = code;
            w.code_column[i] = column;
            w.phases |= phase_bit(code->phase);
            return;
        }
    }
    if (w.code_count == SortedWords::max_codes) raise_alarm(10, column);
    w.code_column[w.code_count] = column;
    w.code[w.code_count++] = code;
    w.phases |= phase_bit(code->phase);
}

void drop_cycle(SortedWords& w) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < w.code_count; ++i) {
        if (w.code[i]->phase == Phase::cycle) continue;
        w.code_column[kept] = w.code_column[i];
        w.code[kept++] = w.code[i];
    }
    w.code_count = kept;
}

void add_g(ControlState& c, const WordValue& word) {
    const GCode* code = find_g_code(word.value);
    if (!code) raise_alarm(10, word.column);
    if (code->phase != Phase::motion) return add_code(c, code, word.column);
    if (c.words.motion && c.settings.duplicates_alarm) raise_alarm(5074, word.column);
    drop_cycle(c.words);  // G81 G0: the cycle is not carried out
    c.words.motion = code;
    c.words.motion_column = word.column;
}

void add_m(ControlState& c, const WordValue& word) {
    SortedWords& w = c.words;
    if (w.m_count == SortedWords::max_codes) raise_alarm(9, word.column);
    w.m_column[w.m_count] = word.column;
    w.m[w.m_count++] = static_cast<int>(word.value + 0.5);
}

void add_letter(ControlState& c, const WordValue& word) {
    SortedWords& w = c.words;
    const std::uint32_t bit = SortedWords::bit(word.letter);
    if ((w.present & bit) && c.settings.duplicates_alarm) raise_alarm(5074, word.column);
    const auto i = static_cast<std::size_t>(word.letter - 'A');
    const double largest = word.decimal_point ? c.largest[i] : c.largest_bare[i];
    if (std::abs(word.value) > largest) raise_alarm(3, word.column);
    w.present |= bit;
    w.value[i] = word.value;
    w.column[i] = word.column;
    if (word.decimal_point)
        w.bare &= ~bit;
    else
        w.bare |= bit;
}

void add_corner(ControlState& c, const WordValue& word) {
    c.words.corner = word.value * (word.decimal_point ? c.unit_mm : c.bare_linear);
    (word.letter == 'r' ? c.words.corner_radius : c.words.corner_chamfer) = true;
}

void run_phase(ControlState& c, Phase phase) {
    if (!(c.words.phases & phase_bit(phase))) return;
    for (std::size_t i = 0; i < c.words.code_count; ++i) {
        const GCode& code = *c.words.code[i];
        if (code.phase != phase) continue;
        c.words.running_column = c.words.code_column[i];
        if (code.handler)
            code.handler(c, code);
        else
            c.modal.set(code.group, code.code10);
    }
    c.words.running_column = 0;
}

/// G92 S_ limits the speed of G96; S is no spindle command then.
bool limits_spindle(const SortedWords& w) {
    for (std::size_t i = 0; i < w.code_count; ++i)
        if (w.code[i]->handler == g_preset) return true;
    return false;
}

void feed_speed_tool(ControlState& c) {
    const SortedWords& w = c.words;
    c.feed.in_block = w.has('F');
    constexpr std::uint32_t fst =
        SortedWords::bit('F') | SortedWords::bit('S') | SortedWords::bit('T');
    if (!(w.present & fst)) return;
    if (w.has('F')) c.feed.programmed = w.get('F') * feed_word_unit(c);
    if (w.has('S') && !limits_spindle(w)) take_s_word(c, w.get('S'));
    if (w.has('F') || w.has('S')) c.feed_changed();
    if (w.has('T')) c.tool_selected = c.whole_word('T');
}

void note_bare_words(ControlState& c) {
    if (!c.settings.bare_is_noted || !(c.words.bare & SortedWords::axis_letters)) return;
    for (const ControlAxis& axis : c.config.axes) {
        const char letter = letter_of(axis.axis);
        if (!c.words.has(letter) || !c.words.is_bare(letter) || c.words.get(letter) == 0.0)
            continue;
        c.note(
            "numbers without a decimal point are read as whole units (parameter 3401 is not "
            "given; with 3401#0 = 0 they would be least increments)");
        c.settings.bare_is_noted = false;
        return;
    }
}

/// One-shot codes that neither move nor change frames: G4, G5, G5.1, G8, G39, G10 of tool data.
bool keeps_path(const ControlState& c, const GCode& code) {
    if (code.handler == g_data_setting) {
        const double l = c.words.get('L', 10.0);
        return l >= 10.0 && l <= 13.0;
    }
    return code.handler == g_dwell || code.handler == g_accepted || code.handler == g_corner_arc;
}

/// Codes that change frames or move by themselves: a compensated path ends before them.
bool pauses_path(const ControlState& c) {
    constexpr std::uint32_t mask = phase_bit(Phase::shot) | phase_bit(Phase::work_offset) |
                                   phase_bit(Phase::frame) | phase_bit(Phase::cycle);
    if ((c.words.phases & mask) == 0) return false;
    for (std::size_t i = 0; i < c.words.code_count; ++i) {
        const GCode& code = *c.words.code[i];
        if ((phase_bit(code.phase) & mask) && !keeps_path(c, code)) return true;
    }
    return false;
}

void queue_motion(ControlState& c, int code) {
    if (code == 20 || code == 30) check_plane_of_centre(c);
    const bool round = (code == 20 || code == 30) && has_arc_words(c);
    if ((code == 20 || code == 30) && !round && c.settings.arc_needs_centre) raise_alarm(22);
    queue_move(c, path_move_of(c, c.target(), code == 20, round));
}

void run_motion(ControlState& c) {
    if (!c.modal.is(ModalGroup::cycle, 800)) return run_cycle(c);
    const int code = c.modal[ModalGroup::motion];
    c.moved = true;
    if (c.polar) return move_polar(c);
    if (uses_path_queue(c)) return queue_motion(c, code);
    switch (code) {
        case 0:
            move_line(c, MotionKind::rapid, c.target());
            return;
        case 10:
            if (c.cylinder) return move_cylinder_line(c);
            move_line(c, MotionKind::linear, c.target());
            return;
        case 20:
        case 30:
            move_arc_block(c, code == 20);
            return;
        default:
            raise_alarm(10);
    }
}

bool moves_by_itself(const ControlState& c) {
    // An arc may have only its centre: a full circle. G43.5 turns the tool alone.
    constexpr std::uint32_t centre =
        SortedWords::bit('I') | SortedWords::bit('J') | SortedWords::bit('K');
    const int code = c.modal[ModalGroup::motion];
    const bool by_centre = code == 20 || code == 30 || (c.five_axis.tcp && c.five_axis.by_vector);
    return by_centre && (c.words.present & centre);
}

/// R alone makes a hole in a canned cycle.
bool cycle_word(const ControlState& c) {
    return c.words.has('R') && !c.modal.is(ModalGroup::cycle, 800);
}

/// H that belongs to no code of the block.
bool h_alone(const SortedWords& w) {
    if (!w.has('H')) return false;
    for (std::size_t i = 0; i < w.code_count; ++i)
        if (w.code[i]->group == ModalGroup::length || w.code[i]->group == ModalGroup::one_shot ||
            w.code[i]->group == ModalGroup::cutter)
            return false;
    return true;
}

void run_codes(ControlState& c) {
    for (const Phase phase : {Phase::plane, Phase::reading, Phase::work_offset, Phase::frame,
                              Phase::offsets, Phase::cycle})
        run_phase(c, phase);
}

}  // namespace

void sort_words(ControlState& c, const BlockWords& block) {
    SortedWords& w = c.words;
    w.clear();
    w.line = block.line;
    w.byte = block.byte;
    for (const WordValue& word : block) {
        if (word.vacant) continue;
        switch (word.letter) {
            case 'G':
                add_g(c, word);
                break;
            case 'M':
                add_m(c, word);
                break;
            case 'r':
            case 'c':
                add_corner(c, word);
                break;
            default:
                add_letter(c, word);
        }
    }
    const std::uint32_t allowed = (known_letters & ~SortedWords::axis_letters) | c.axis_letters;
    if (const std::uint32_t strange = w.present & ~allowed)
        raise_alarm(9, w.column[static_cast<std::size_t>(std::countr_zero(strange))]);
}

namespace {

void execute(ControlState& c, const BlockWords& block) {
    sort_words(c, block);
    const SortedWords& w = c.words;
    c.moved = false;
    if (c.five_axis.active) five_axis_block_begin(c);
    if (c.data_entry != DataEntry::none && w.code_count == 0) return enter_data(c, block);
    if (w.phases & before_words)
        for (const Phase phase : {Phase::speed, Phase::feed, Phase::units}) run_phase(c, phase);
    if (w.bare) note_bare_words(c);
    feed_speed_tool(c);
    if (w.m_count) m_codes_before(c);
    if (w.motion) {
        c.modal.set(ModalGroup::motion, w.motion->code10);
        c.modal.set(ModalGroup::cycle, 800);
    }
    c.move.line = w.line;
    c.move.byte = w.byte;
    const ControlPosition stood = c.machine;
    const bool paused = c.path.engaged && pauses_path(c);
    if (paused) pause_path(c);
    if (w.phases) run_codes(c);
    if (h_alone(w)) change_length_number(c);
    c.move.gap_free = !c.exact_stop_once && !c.modal.is(ModalGroup::path_mode, 610);
    if (w.phases & phase_bit(Phase::shot))
        run_phase(c, Phase::shot);
    else if (w.has_axis() || moves_by_itself(c) || c.length_moves || cycle_word(c))
        run_motion(c);
    c.length_moves = c.exact_stop_once = false;
    if (c.five_axis.active) five_axis_block_end(c);
    c.moved = c.moved || !(c.machine == stood);
    if (paused) resume_path(c, !(c.machine == stood));
    if (w.m_count) {
        m_codes_after(c);
        if (c.ended) flush_path(c);
    }
}

}  // namespace

void execute_block(ControlState& c, const BlockWords& block) try {
    execute(c, block);
} catch (Alarm& alarm) {
    const bool of_this_block = alarm.where.line == 0;  // a held move names its own line
    if (of_this_block && alarm.where.column == 0) alarm.where.column = c.words.column_at_fault();
    throw;
}

}  // namespace trunnion

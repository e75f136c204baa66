#include "controller/cycles.h"

#include <cmath>

#include "controller/alarms.h"
#include "controller/commanded.h"
#include "controller/word_readings.h"

namespace trunnion::controller {

namespace {

/// BNC: distances are measured down from the level where the cycle began.
void take_distances(const CycleData& data, const Modal& modal, HoleOrder& hole) {
    hole.r = data.initial_level - data.level_r;
    hole.bottom = data.initial_level - data.depth;
    const bool from_start =
        modal.is(ModalGroup::cycle_return, 980) && !modal.settings.hurco.g98_feeds_from_r;
    hole.feed_from = from_start ? data.initial_level : hole.r;
}

HoleOrder order_of(const CycleData& data, const Modal& modal) {
    HoleOrder hole;
    hole.initial = data.initial_level;
    hole.peck = data.peck;
    hole.next_peck = data.next_peck;
    hole.dwell_s = data.dwell_s;
    if (modal.settings.is_bnc()) {
        take_distances(data, modal, hole);
        return hole;
    }
    hole.r = !data.has_r           ? data.initial_level
             : data.r_from_initial ? data.initial_level + data.level_r
                                   : data.level_r;
    hole.bottom = data.depth_from_r ? hole.r + data.depth : data.depth;
    hole.feed_from = hole.r;
    return hole;
}

void read_pecks(CycleData& data, const SortedWords& words) {
    if (words.has('Q')) data.peck = data.next_peck = std::abs(words.length_mm('Q'));
    if (words.more_depth_count == 0) return;
    const auto depth_mm = [&](std::size_t i) {
        return std::abs(words.more_depths[i]) * words.units.unit_mm;
    };
    data.peck = depth_mm(0);
    data.next_peck = depth_mm(words.more_depth_count - 1);
}

/// BNC: a negative distance would lead the tool up from the start level.
void require_distances(const SortedWords& words, char depth_word) {
    for (const char letter : {depth_word, 'R'})
        if (words.has(letter) && words.length_mm(letter) < 0.0)
            raise_alarm(6, words.column_of(letter));
    for (std::size_t i = 0; i < words.more_depth_count; ++i)
        if (words.more_depths[i] < 0.0) raise_alarm(6, words.column_of(depth_word));
}

void read_cycle_words(CycleData& data, const SortedWords& words, const Modal& modal) {
    const char depth_word = letter_of(modal.plane().normal);
    const bool relative = !modal.absolute();
    if (modal.settings.is_bnc()) require_distances(words, depth_word);
    if (words.has('R')) {
        data.level_r = words.length_mm('R');
        data.r_from_initial = relative;
        data.has_r = true;
    }
    if (words.has(depth_word)) {
        data.depth = words.length_mm(depth_word);
        data.depth_from_r = relative;
    }
    read_pecks(data, words);
    if (words.has('P')) data.dwell_s = dwell_word_s(words, modal);
}

/// Under M128: drills to depth I along the tool, starting R above the point.
void drill_along_tool(const CycleRow& row, const SortedWords& words, Modal& modal,
                      const Frames& frames, Mover& mover) {
    const bool allowed = row.code10 != 760 && row.code10 != 870 && row.code10 != 880;
    if (!allowed || !modal.absolute() || !words.has('I'))
        raise_alarm(5421, "(under M128 a cycle has I and R, G90, and is not G76, G87 or G88)");
    if (words.length_mm('I') < 0.0) raise_alarm(6, words.column_of('I'));
    offsets::ControlPosition place = commanded_position(words, modal, frames);
    CycleData data;
    read_pecks(data, words);
    HoleOrder hole;
    hole.row = &row;
    hole.initial = hole.r = hole.feed_from = words.length_mm('R');
    hole.bottom = -words.length_mm('I');
    hole.peck = data.peck;
    hole.next_peck = data.next_peck;
    hole.dwell_s = words.has('P') ? dwell_word_s(words, modal) : 0.0;
    hole.foot = offsets::xyz_of(place);
    const motion::ToolCentrePoint& tcp = *frames.tip.in_force;
    const AxisPositions there =
        offsets::axis_positions_of(frames.stages.machine_from_program(place));
    hole.axis = (tcp.pose_WM0.rotation * frames.stages.linear()).transpose() *
                tcp.transform->tool_direction_W(there);
    offsets::set_xyz(place, *hole.foot + hole.r * hole.axis);
    make_hole(hole, place, modal, frames, mover);
    modal.codes.set(ModalGroup::cycle, 800);
}

}  // namespace

void start_cycle(CycleData& data, Modal& modal, const Frames& frames, int code10) {
    if (!modal.in_cycle()) {
        data = {};
        data.initial_level = frames.program[modal.plane().normal];
        data.depth = modal.settings.is_bnc() ? 0.0 : data.initial_level;
    }
    modal.codes.set(ModalGroup::cycle, code10);
}

void run_cycle(CycleData& data, SortedWords& words, Modal& modal, const Frames& frames,
               Mover& mover) {
    const CycleRow* row = find_cycle(modal.codes[ModalGroup::cycle], modal.settings);
    if (!row) raise_alarm(10);
    if (frames.tip.in_force && frames.tip.by_angle_or_vector)
        return drill_along_tool(*row, words, modal, frames, mover);
    read_cycle_words(data, words, modal);
    if (!words.has_axis() && !words.has('R')) return;
    const Axis normal = modal.plane().normal;
    words.present &= ~SortedWords::bit(letter_of(normal));  // this word is the depth
    const char times_word = words.has('K') ? 'K' : 'L';
    const int times = words.has(times_word) ? words.whole(times_word) : 1;
    HoleOrder hole = order_of(data, modal);
    hole.row = row;
    hole.times = times;
    for (int i = 0; i < times; ++i) {
        offsets::ControlPosition place = commanded_position(words, modal, frames);
        place[normal] = frames.program[normal];
        make_hole(hole, place, modal, frames, mover);
    }
}

}  // namespace trunnion::controller

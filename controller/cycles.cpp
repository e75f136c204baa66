#include "controller/cycles.h"

#include <algorithm>
#include <cmath>

#include "controller/g_codes.h"
#include "controller/g_handlers.h"
#include "controller/moves.h"

namespace trunnion {

namespace {

using Cut = CycleRow::Cut;
using Leave = CycleRow::Leave;

constexpr CycleRow rows[] = {
    {730, Cut::chip_break, Leave::rapid, false, "pecking with chip breaking"},
    {740, Cut::straight, Leave::tap, true, "left-hand tapping"},
    {760, Cut::straight, Leave::shifted_rapid, true, "fine boring"},
    {810, Cut::straight, Leave::rapid, false, "drilling"},
    {820, Cut::straight, Leave::rapid, true, "drilling with dwell"},
    {830, Cut::full_retreat, Leave::rapid, false, "pecking"},
    {840, Cut::straight, Leave::tap, true, "tapping"},
    {850, Cut::straight, Leave::feed, false, "boring, feed out"},
    {860, Cut::straight, Leave::stopped_rapid, false, "boring, spindle stop, rapid out"},
    {870, Cut::back_boring, Leave::rapid, false, "back boring"},
    {880, Cut::straight, Leave::stopped_rapid, true, "boring, dwell, stop, rapid out"},
    {890, Cut::straight, Leave::feed, true, "boring with dwell, feed out"},
};

/// The levels of one hole along the drilling axis, program coordinates in mm.
struct Levels {
    double initial, r, bottom;
};

Levels levels_of(const ControlState& c) {
    const CycleState& cycle = c.cycle;
    Levels out{cycle.initial_level, 0.0, 0.0};
    out.r = cycle.r_from_initial ? cycle.initial_level + cycle.level_r : cycle.level_r;
    out.bottom = cycle.depth_from_r ? out.r + cycle.depth : cycle.depth;
    return out;
}

void go_to_level(ControlState& c, MotionKind kind, double level) {
    ControlPosition target = c.program;
    target[plane_axes(c.modal).normal] = level;
    move_line(c, kind, target);
}

/// The tool point leaves the wall: by Q along the first axis of the plane (5148: +first, assumed).
void shift_tool(ControlState& c, double by) {
    ControlPosition target = c.program;
    target[plane_axes(c.modal).first] += by;
    move_line(c, MotionKind::rapid, target);
}

void turn_spindle(ControlState& c, int direction) {
    if (c.spindle.direction != direction) c.pace.stop();
    c.spindle.direction = direction;
    c.feed_changed();
}

void need_peck(const ControlState& c) {
    if (c.cycle.peck <= 0.0) raise_alarm(45);
}

/// G73: down by Q, back by 5114. G83: down by Q, out to R, in again to 5115 above the last depth.
void peck(ControlState& c, const Levels& at, bool out_of_hole) {
    need_peck(c);
    const double way = at.bottom < at.r ? -1.0 : 1.0;
    const double total = std::abs(at.bottom - at.r);
    for (double done = 0.0;;) {
        done = std::min(done + c.cycle.peck, total);
        if (total - done < 1e-9) done = total;
        go_to_level(c, MotionKind::linear, done == total ? at.bottom : at.r + way * done);
        if (done == total) return;
        if (out_of_hole) {
            go_to_level(c, MotionKind::rapid, at.r);
            go_to_level(c, MotionKind::rapid,
                        at.r + way * std::max(0.0, done - c.settings.peck_clearance_mm));
        } else {
            go_to_level(c, MotionKind::rapid,
                        at.r + way * std::max(0.0, done - c.settings.peck_return_mm));
        }
    }
}

void leave(ControlState& c, const CycleRow& row, const Levels& at) {
    const int direction = c.spindle.direction;
    const bool to_r = c.modal.is(ModalGroup::cycle_return, 990);
    const double top = to_r ? at.r : at.initial;
    switch (row.leave) {
        case Leave::rapid:
            go_to_level(c, MotionKind::rapid, top);
            break;
        case Leave::feed:
            if (row.code10 != 890 || !c.config.g89_feeds_to_initial)
                go_to_level(c, MotionKind::linear, at.r);
            go_to_level(c,
                        row.code10 == 890 && c.config.g89_feeds_to_initial ? MotionKind::linear
                                                                           : MotionKind::rapid,
                        top);
            break;
        case Leave::tap:
            turn_spindle(c, row.code10 == 840 ? -1 : 1);
            go_to_level(c, MotionKind::linear, at.r);
            turn_spindle(c, direction);
            go_to_level(c, MotionKind::rapid, top);
            break;
        case Leave::stopped_rapid:
            turn_spindle(c, 0);
            go_to_level(c, MotionKind::rapid, top);
            turn_spindle(c, direction);
            break;
        case Leave::shifted_rapid:
            turn_spindle(c, 0);
            shift_tool(c, c.cycle.peck);
            go_to_level(c, MotionKind::rapid, top);
            shift_tool(c, -c.cycle.peck);
            turn_spindle(c, direction);
            break;
    }
}

/// G87: in beside the hole to R, back under it, feed up to Z, out beside the hole.
void bore_back(ControlState& c, const Levels& at) {
    const int direction = c.spindle.direction;
    turn_spindle(c, 0);
    shift_tool(c, c.cycle.peck);
    go_to_level(c, MotionKind::rapid, at.r);
    shift_tool(c, -c.cycle.peck);
    turn_spindle(c, direction ? direction : 1);
    go_to_level(c, MotionKind::linear, at.bottom);
    if (c.cycle.dwell_s > 0.0) dwell(c, c.cycle.dwell_s);
    turn_spindle(c, 0);
    shift_tool(c, c.cycle.peck);
    go_to_level(c, MotionKind::rapid, at.initial);
    shift_tool(c, -c.cycle.peck);
    turn_spindle(c, direction);
}

void make_hole(ControlState& c, const CycleRow& row, const ControlPosition& place) {
    const Levels at = levels_of(c);
    move_line(c, MotionKind::rapid, place);
    if (row.cut == Cut::back_boring) return bore_back(c, at);
    go_to_level(c, MotionKind::rapid, at.r);
    const int direction = c.spindle.direction;
    if (row.leave == Leave::tap) turn_spindle(c, row.code10 == 840 ? 1 : -1);
    if (row.cut == Cut::straight)
        go_to_level(c, MotionKind::linear, at.bottom);
    else
        peck(c, at, row.cut == Cut::full_retreat);
    if (row.dwell && c.cycle.dwell_s > 0.0) dwell(c, c.cycle.dwell_s);
    leave(c, row, at);
    turn_spindle(c, direction);
}

void read_cycle_words(ControlState& c) {
    const SortedWords& w = c.words;
    CycleState& cycle = c.cycle;
    const char depth_word = letter_of(plane_axes(c.modal).normal);
    const bool relative = !c.absolute();
    if (w.has('R')) {
        cycle.level_r = c.length_word('R');
        cycle.r_from_initial = relative;
    }
    if (w.has(depth_word)) {
        cycle.depth = c.length_word(depth_word);
        cycle.depth_from_r = relative;
    }
    if (w.has('Q')) cycle.peck = std::abs(c.length_word('Q'));
    if (w.has('P')) cycle.dwell_s = c.whole_word('P') * 0.001;
}

}  // namespace

const CycleRow* find_cycle(int code10) {
    const auto it = std::find_if(std::begin(rows), std::end(rows),
                                 [code10](const CycleRow& row) { return row.code10 == code10; });
    return it == std::end(rows) ? nullptr : &*it;
}

void g_cycle(ControlState& c, const GCode& code) {
    if (c.modal.is(ModalGroup::cycle, 800)) {
        const double level = c.program[plane_axes(c.modal).normal];
        c.cycle = CycleState{};
        c.cycle.initial_level = c.cycle.level_r = c.cycle.depth = level;
    }
    c.modal.set(ModalGroup::cycle, code.code10);
}

void run_cycle(ControlState& c) {
    const CycleRow* row = find_cycle(c.modal[ModalGroup::cycle]);
    if (!row) raise_alarm(10);
    read_cycle_words(c);
    if (!c.words.has_axis() && !c.words.has('R')) return;
    const PlaneAxes& plane = plane_axes(c.modal);
    c.words.present &= ~SortedWords::bit(letter_of(plane.normal));  // that word is the depth
    const char times_word = c.words.has('K') ? 'K' : 'L';
    const int times = c.words.has(times_word) ? c.whole_word(times_word) : 1;
    for (int i = 0; i < times; ++i) {
        ControlPosition place = c.target();
        place[plane.normal] = c.program[plane.normal];
        make_hole(c, *row, place);
    }
}

}  // namespace trunnion

#include "controller/cycles.h"

#include <algorithm>
#include <cmath>

#include "controller/alarms.h"
#include "controller/commanded.h"

namespace trunnion::controller {

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

Levels levels_of(const CycleData& data) {
    Levels out{data.initial_level, 0.0, 0.0};
    out.r = data.r_from_initial ? data.initial_level + data.level_r : data.level_r;
    out.bottom = data.depth_from_r ? out.r + data.depth : data.depth;
    return out;
}

/// One hole: what it is made of and by whom.
class Hole {
  public:
    Hole(const CycleRow& row, const CycleData& data, Modal& modal, const Frames& frames,
         Mover& mover)
        : row_(row),
          data_(data),
          modal_(modal),
          frames_(frames),
          mover_(mover),
          at_(levels_of(data)) {}

    void make(const offsets::ControlPosition& place);

  private:
    void go_to(motion::MotionKind kind, double level);
    void shift_tool(double by);
    void turn_spindle(int direction);
    void peck(bool out_of_hole);
    void leave();
    void leave_by_feed(double top);
    void bore_back();

    const CycleRow& row_;
    const CycleData& data_;
    Modal& modal_;
    const Frames& frames_;
    Mover& mover_;
    Levels at_;
};

void Hole::go_to(motion::MotionKind kind, double level) {
    offsets::ControlPosition target = frames_.program;
    target[modal_.plane().normal] = level;
    mover_.line(kind, target);
}

/// The tool point leaves the wall: by Q along the first axis of the plane (5148: +first, assumed).
void Hole::shift_tool(double by) {
    offsets::ControlPosition target = frames_.program;
    target[modal_.plane().first] += by;
    mover_.line(motion::MotionKind::rapid, target);
}

void Hole::turn_spindle(int direction) {
    if (modal_.spindle.direction != direction) mover_.axes.stop();
    modal_.spindle.direction = direction;
    modal_.feed_changed();
}

/// G73: down by Q, back by 5114. G83: down by Q, out to R, in again to 5115 above the last depth.
void Hole::peck(bool out_of_hole) {
    if (data_.peck <= 0.0) raise_alarm(45);
    const ControlSettings& settings = modal_.settings;
    const double way = at_.bottom < at_.r ? -1.0 : 1.0;
    const double total = std::abs(at_.bottom - at_.r);
    const double back = out_of_hole ? settings.peck_clearance_mm : settings.peck_return_mm;
    for (double done = 0.0;;) {
        done = std::min(done + data_.peck, total);
        if (total - done < 1e-9) done = total;
        go_to(motion::MotionKind::linear, done == total ? at_.bottom : at_.r + way * done);
        if (done == total) return;
        if (out_of_hole) go_to(motion::MotionKind::rapid, at_.r);
        go_to(motion::MotionKind::rapid, at_.r + way * std::max(0.0, done - back));
    }
}

void Hole::leave_by_feed(double top) {
    const bool all_the_way = row_.code10 == 890 && modal_.settings.g89_feeds_to_initial;
    if (!all_the_way) go_to(motion::MotionKind::linear, at_.r);
    go_to(all_the_way ? motion::MotionKind::linear : motion::MotionKind::rapid, top);
}

void Hole::leave() {
    const int direction = modal_.spindle.direction;
    const double top = modal_.is(ModalGroup::cycle_return, 990) ? at_.r : at_.initial;
    switch (row_.leave) {
        case Leave::rapid:
            return go_to(motion::MotionKind::rapid, top);
        case Leave::feed:
            return leave_by_feed(top);
        case Leave::tap:
            turn_spindle(row_.code10 == 840 ? -1 : 1);
            go_to(motion::MotionKind::linear, at_.r);
            turn_spindle(direction);
            return go_to(motion::MotionKind::rapid, top);
        case Leave::stopped_rapid:
            turn_spindle(0);
            go_to(motion::MotionKind::rapid, top);
            return turn_spindle(direction);
        case Leave::shifted_rapid:
            turn_spindle(0);
            shift_tool(data_.peck);
            go_to(motion::MotionKind::rapid, top);
            shift_tool(-data_.peck);
            return turn_spindle(direction);
    }
}

/// G87: in beside the hole to R, back under it, feed up to Z, out beside the hole.
void Hole::bore_back() {
    const int direction = modal_.spindle.direction;
    turn_spindle(0);
    shift_tool(data_.peck);
    go_to(motion::MotionKind::rapid, at_.r);
    shift_tool(-data_.peck);
    turn_spindle(direction ? direction : 1);
    go_to(motion::MotionKind::linear, at_.bottom);
    if (data_.dwell_s > 0.0) mover_.axes.dwell(data_.dwell_s);
    turn_spindle(0);
    shift_tool(data_.peck);
    go_to(motion::MotionKind::rapid, at_.initial);
    shift_tool(-data_.peck);
    turn_spindle(direction);
}

void Hole::make(const offsets::ControlPosition& place) {
    mover_.line(motion::MotionKind::rapid, place);
    if (row_.cut == Cut::back_boring) return bore_back();
    go_to(motion::MotionKind::rapid, at_.r);
    const int direction = modal_.spindle.direction;
    if (row_.leave == Leave::tap) turn_spindle(row_.code10 == 840 ? 1 : -1);
    if (row_.cut == Cut::straight)
        go_to(motion::MotionKind::linear, at_.bottom);
    else
        peck(row_.cut == Cut::full_retreat);
    if (row_.dwell && data_.dwell_s > 0.0) mover_.axes.dwell(data_.dwell_s);
    leave();
    turn_spindle(direction);
}

void read_cycle_words(CycleData& data, const SortedWords& words, const Modal& modal) {
    const char depth_word = letter_of(modal.plane().normal);
    const bool relative = !modal.absolute();
    if (words.has('R')) {
        data.level_r = words.length_mm('R');
        data.r_from_initial = relative;
    }
    if (words.has(depth_word)) {
        data.depth = words.length_mm(depth_word);
        data.depth_from_r = relative;
    }
    if (words.has('Q')) data.peck = std::abs(words.length_mm('Q'));
    if (words.has('P')) data.dwell_s = words.whole('P') * 0.001;
}

}  // namespace

const CycleRow* find_cycle(int code10) {
    const auto it = std::find_if(std::begin(rows), std::end(rows),
                                 [code10](const CycleRow& row) { return row.code10 == code10; });
    return it == std::end(rows) ? nullptr : &*it;
}

void start_cycle(CycleData& data, Modal& modal, const Frames& frames, int code10) {
    if (!modal.in_cycle()) {
        data = {};
        data.initial_level = data.level_r = data.depth = frames.program[modal.plane().normal];
    }
    modal.codes.set(ModalGroup::cycle, code10);
}

void run_cycle(CycleData& data, SortedWords& words, Modal& modal, const Frames& frames,
               Mover& mover) {
    const CycleRow* row = find_cycle(modal.codes[ModalGroup::cycle]);
    if (!row) raise_alarm(10);
    read_cycle_words(data, words, modal);
    if (!words.has_axis() && !words.has('R')) return;
    const Axis normal = modal.plane().normal;
    words.present &= ~SortedWords::bit(letter_of(normal));  // that word is the depth
    const char times_word = words.has('K') ? 'K' : 'L';
    const int times = words.has(times_word) ? words.whole(times_word) : 1;
    Hole hole(*row, data, modal, frames, mover);
    for (int i = 0; i < times; ++i) {
        offsets::ControlPosition place = commanded_position(words, modal, frames);
        place[normal] = frames.program[normal];
        hole.make(place);
    }
}

}  // namespace trunnion::controller

#include "controller/holes.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "controller/alarms.h"

namespace trunnion::controller {

namespace {

using Cut = CycleRow::Cut;
using Leave = CycleRow::Leave;

constexpr CycleRow rows[] = {
    {730, Cut::chip_break, Leave::rapid, false, "pecking with chip breaking"},
    {740, Cut::straight, Leave::tap, true, "left-hand tapping", -1},
    {760, Cut::straight, Leave::shifted_rapid, true, "fine boring"},
    {810, Cut::straight, Leave::rapid, false, "drilling"},
    {820, Cut::straight, Leave::rapid, true, "drilling with dwell"},
    {830, Cut::full_retreat, Leave::rapid, false, "pecking"},
    {840, Cut::straight, Leave::tap, true, "tapping", 1},
    {842, Cut::straight, Leave::tap, true, "rigid tapping", 1},
    {843, Cut::straight, Leave::tap, true, "left-hand rigid tapping", -1},
    {850, Cut::straight, Leave::feed, false, "boring, feed out"},
    {860, Cut::straight, Leave::stopped_rapid, false, "boring, spindle stop, rapid out"},
    {870, Cut::back_boring, Leave::rapid, false, "back boring"},
    {880, Cut::straight, Leave::stopped_rapid, true, "boring, dwell, stop, rapid out"},
    {890, Cut::straight, Leave::feed, true, "boring with dwell, feed out"},
};

/// Rows for a Hurco; they have priority over those above.
constexpr CycleRow isnc_rows[] = {
    {842, Cut::tap_pecks, Leave::tap, true, "peck tapping", 1},
    {843, Cut::tap_pecks, Leave::tap, true, "peck tapping, left-hand", -1},
};
constexpr CycleRow isnc_feeds_out = {860, Cut::straight, Leave::feed, false, "boring, feed out"};
constexpr CycleRow bnc_tap = {880, Cut::tap_pecks, Leave::tap, true, "rigid tapping"};

/// Execution of one hole.
class Hole {
  public:
    Hole(const CycleRow& row, const HoleOrder& order, Modal& modal, const Frames& frames,
         Mover& mover)
        : row_(row), at_(order), modal_(modal), frames_(frames), mover_(mover) {}

    void make(const offsets::ControlPosition& place);

  private:
    void go_to(motion::MotionKind kind, double level);
    void shift_tool(double by);
    void turn_spindle(int direction);
    void peck();
    void come_back(double done, double way);
    void tap_out();
    void leave();
    void leave_by_feed(double top);
    void bore_back();

    const CycleRow& row_;
    const HoleOrder& at_;
    Modal& modal_;
    const Frames& frames_;
    Mover& mover_;
};

void Hole::go_to(motion::MotionKind kind, double level) {
    offsets::ControlPosition target = frames_.program;
    if (at_.foot)
        offsets::set_xyz(target, *at_.foot + level * at_.axis);
    else
        target[modal_.plane().normal] = level;
    mover_.line(kind, target);
}

/// Shifts the tool point away from the wall: by Q along the first axis of the plane (5148: +first,
/// assumed).
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

/// G73: down by Q, retract by 5114. G83: down by Q, out to R, in again to 5115 above the last
/// depth. Tapping: out to R by feed with reversed spindle, and in again (assumed).
void Hole::peck() {
    // The control rounds Q to its least increment (that of IS-C, assumed): a smaller one is none.
    constexpr double least_mm = 0.5e-4, most_pecks = 1e6;
    const double way = at_.bottom < at_.r ? -1.0 : 1.0;
    const double total = std::abs(at_.bottom - at_.r);
    if (!(std::min(at_.peck, at_.next_peck) >= least_mm)) raise_alarm(45);
    // A run can be ended between two blocks only.
    if (total / at_.next_peck * at_.times > most_pecks) raise_alarm(9007);
    for (double done = 0.0, next = at_.peck;; next = at_.next_peck) {
        done = std::min(done + next, total);
        if (total - done < 1e-9) done = total;
        go_to(motion::MotionKind::linear, done == total ? at_.bottom : at_.r + way * done);
        if (done == total) return;
        come_back(done, way);
    }
}

void Hole::come_back(double done, double way) {
    const ControlSettings& settings = modal_.settings;
    if (row_.cut == Cut::tap_pecks) return tap_out();
    const bool out_of_hole = row_.cut == Cut::full_retreat;
    const double back = out_of_hole ? settings.peck_clearance_mm : settings.peck_return_mm;
    if (out_of_hole) go_to(motion::MotionKind::rapid, at_.r);
    go_to(motion::MotionKind::rapid, at_.r + way * std::max(0.0, done - back));
}

/// Out to R with the lead of the thread; then the spindle direction is restored.
void Hole::tap_out() {
    const int direction = modal_.spindle.direction;
    turn_spindle(-direction);
    go_to(motion::MotionKind::linear, at_.r);
    turn_spindle(direction);
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
        case Leave::rapid: return go_to(motion::MotionKind::rapid, top);
        case Leave::feed: return leave_by_feed(top);
        case Leave::tap: tap_out(); return go_to(motion::MotionKind::rapid, top);
        case Leave::stopped_rapid:
            turn_spindle(0);
            go_to(motion::MotionKind::rapid, top);
            return turn_spindle(direction);
        case Leave::shifted_rapid:
            turn_spindle(0);
            shift_tool(at_.peck);
            go_to(motion::MotionKind::rapid, top);
            shift_tool(-at_.peck);
            return turn_spindle(direction);
    }
}

/// G87: in beside the hole to R, shift back below it, feed up to Z, out beside the hole.
void Hole::bore_back() {
    const int direction = modal_.spindle.direction;
    turn_spindle(0);
    shift_tool(at_.peck);
    go_to(motion::MotionKind::rapid, at_.r);
    shift_tool(-at_.peck);
    turn_spindle(direction ? direction : 1);
    go_to(motion::MotionKind::linear, at_.bottom);
    if (at_.dwell_s > 0.0) mover_.axes.dwell(at_.dwell_s);
    turn_spindle(0);
    shift_tool(at_.peck);
    go_to(motion::MotionKind::rapid, at_.initial);
    shift_tool(-at_.peck);
    turn_spindle(direction);
}

void Hole::make(const offsets::ControlPosition& place) {
    mover_.line(motion::MotionKind::rapid, place);
    if (row_.cut == Cut::back_boring) return bore_back();
    go_to(motion::MotionKind::rapid, at_.feed_from);
    const int direction = modal_.spindle.direction;
    if (row_.spindle != 0) turn_spindle(row_.spindle);
    if (row_.cut == Cut::straight || (row_.cut == Cut::tap_pecks && at_.peck <= 0.0))
        go_to(motion::MotionKind::linear, at_.bottom);
    else
        peck();
    if (row_.dwell && at_.dwell_s > 0.0) mover_.axes.dwell(at_.dwell_s);
    leave();
    turn_spindle(direction);
}

const CycleRow* row_in(std::span<const CycleRow> table, int code10) {
    const auto it = std::find_if(table.begin(), table.end(),
                                 [code10](const CycleRow& row) { return row.code10 == code10; });
    return it == table.end() ? nullptr : &*it;
}

}  // namespace

const CycleRow* find_cycle(int code10, const ControlSettings& settings) {
    if (settings.is_bnc() && code10 == bnc_tap.code10) return &bnc_tap;
    if (settings.is_hurco() && !settings.hurco.bnc) {
        if (code10 == isnc_feeds_out.code10 && settings.hurco.g86_feeds_out) return &isnc_feeds_out;
        if (const CycleRow* row = row_in(isnc_rows, code10)) return row;
    }
    return row_in(rows, code10);
}

void make_hole(const HoleOrder& order, const offsets::ControlPosition& place, Modal& modal,
               const Frames& frames, Mover& mover) {
    Hole(*order.row, order, modal, frames, mover).make(place);
}

}  // namespace trunnion::controller

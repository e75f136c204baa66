#include "controller/skip.h"

#include "controller/alarms.h"
#include "controller/commanded.h"

namespace trunnion::controller {

offsets::ControlPosition work_position(const Modal& modal, const Frames& frames) {
    offsets::ControlPosition out = frames.stages.shaped_from_program(frames.program);
    if (!modal.settings.work_positions_with_length) return out;
    const offsets::ControlPosition length = frames.shown_length();
    for (std::size_t i = 0; i < axis_count; ++i) out.value[i] += length.value[i];
    return out;
}

namespace {

bool touch(const offsets::ControlPosition& target, Mover& mover) {
    mover.axes.until_skip(true);
    const bool touched = mover.line(motion::MotionKind::linear, target).skipped;
    mover.axes.until_skip(false);
    return touched;
}

/// M42: retracts along the path, at most to its start, then moves to the target at the lower feed.
bool touch_again(const offsets::ControlPosition& from, const offsets::ControlPosition& target,
                 Modal& modal, const Frames& frames, Mover& mover) {
    offsets::ControlPosition back = frames.program;
    const Vector3 way = offsets::xyz_of(from) - offsets::xyz_of(back);
    const double part = way.norm() > modal.settings.hurco.back_off_mm
                            ? modal.settings.hurco.back_off_mm / way.norm()
                            : 1.0;
    offsets::set_xyz(back, offsets::xyz_of(back) + part * way);
    mover.line(motion::MotionKind::linear, back);
    const motion::FeedState feed = modal.block.feed;
    modal.block.feed.mm_min *= modal.settings.hurco.second_touch_feed;
    modal.block.feed.seconds_per_mm /= modal.settings.hurco.second_touch_feed;
    const bool touched = touch(target, mover);
    modal.block.feed = feed;
    return touched;
}

/// P of a Fanuc's G31. P1 to P4 and P99 end at the skip signal. P98 ends at a torque limit alone
/// (B-63944EN-1/02 p. 27): with nothing in its way it arrives, else where the drive gives up is not
/// known. P90, the continuous skip, is refused (from memory).
int skip_number(const SortedWords& words, const Modal& modal) {
    const int p = words.has('P') && !modal.settings.is_hurco() ? words.whole('P') : 0;
    if (p == 90) raise_alarm(9006, "(G31 P90)", words.column_of('P'));
    return p;
}

}  // namespace

void skip_move(SkipState& skip, const SortedWords& words, Modal& modal, const Frames& frames,
               Mover& mover) {
    if (!modal.cutter_is_off()) raise_alarm(36);
    skip.triggered = false;
    const bool by_torque = skip_number(words, modal) == 98;
    if (words.has_axis() || (words.present & tool_vector_letters)) {
        const offsets::ControlPosition from = frames.program;
        const offsets::ControlPosition target = commanded_position(words, modal, frames);
        skip.triggered = touch(target, mover);
        if (skip.triggered && by_torque) raise_alarm(9006, "(G31 P98)", words.column_of('P'));
        if (skip.triggered && modal.touches_twice)
            skip.triggered = touch_again(from, target, modal, frames, mover);
    }
    skip.work = work_position(modal, frames);
}

}  // namespace trunnion::controller

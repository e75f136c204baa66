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

}  // namespace

void skip_move(SkipState& skip, const SortedWords& words, Modal& modal, const Frames& frames,
               Mover& mover) {
    if (!modal.cutter_is_off()) raise_alarm(36);
    skip.triggered = false;
    if (words.has_axis() || (words.present & tool_vector_letters)) {
        const offsets::ControlPosition from = frames.program;
        const offsets::ControlPosition target = commanded_position(words, modal, frames);
        skip.triggered = touch(target, mover);
        if (skip.triggered && modal.touches_twice)
            skip.triggered = touch_again(from, target, modal, frames, mover);
    }
    skip.work = work_position(modal, frames);
}

}  // namespace trunnion::controller

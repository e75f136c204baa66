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

void skip_move(SkipState& skip, const SortedWords& words, Modal& modal, const Frames& frames,
               Mover& mover) {
    if (!modal.cutter_is_off()) raise_alarm(36);
    skip.triggered = false;
    if (words.has_axis() || (words.present & tool_vector_letters)) {
        mover.axes.until_skip(true);
        skip.triggered =
            mover.line(motion::MotionKind::linear, commanded_position(words, modal, frames))
                .skipped;
        mover.axes.until_skip(false);
    }
    skip.work = work_position(modal, frames);
}

}  // namespace trunnion::controller

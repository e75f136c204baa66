#include "controller/single_direction.h"

#include <algorithm>
#include <cmath>

#include "controller/alarms.h"
#include "controller/commanded.h"

namespace trunnion::controller {

namespace {

constexpr double rounding = 1e-9;  ///< mm or deg: an axis that stands

}  // namespace

void position_in_one_direction(const SortedWords& words, Modal& modal, const Frames& frames,
                               Mover& mover) {
    if (frames.tip.in_force) raise_alarm(5421);
    if (modal.in_cycle() || !modal.cutter_is_off()) raise_alarm(9005);
    const offsets::ControlPosition end = commanded_position(words, modal, frames);
    // In machine coordinates, because mirror image does not change the direction of 5440.
    const offsets::ControlPosition arrival = frames.stages.machine_from_program(end);
    offsets::ControlPosition before = arrival;
    for (const ControlAxis& entry : modal.settings.axes) {
        const double overrun = modal.settings.overrun[index_of(entry.axis)];
        const double way = arrival[entry.axis] - frames.machine[entry.axis];
        if (std::abs(way) > rounding) before[entry.axis] -= overrun;
    }
    const auto& overruns = modal.settings.overrun;
    if (std::all_of(overruns.begin(), overruns.end(), [](double o) { return o == 0.0; }))
        mover.note("G60 without an overrun (parameter 5440) is a plain rapid");
    if (!(before == arrival)) mover.axes.to_machine(motion::MotionKind::rapid, before);
    mover.line(motion::MotionKind::rapid, end);
}

}  // namespace trunnion::controller

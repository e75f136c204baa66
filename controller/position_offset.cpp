#include "controller/position_offset.h"

#include <cmath>

#include "controller/alarms.h"
#include "controller/commanded.h"

namespace trunnion::controller {

namespace {

struct OffsetCode {
    int code10;
    double times;  ///< of the offset that the way grows by
};
constexpr OffsetCode offset_codes[] = {{450, 1.0}, {460, -1.0}, {470, 2.0}, {480, -2.0}};

/// 0 without one of the codes in the block.
double growth_mm(const SortedWords& words, const Modal& modal, const Frames& frames) {
    if (words.code_count == 0) return 0.0;
    for (const OffsetCode& code : offset_codes)
        if (words.has_code(code.code10))
            return code.times * frames.stores()
                                    .tools.tool[static_cast<std::size_t>(modal.number.radius)]
                                    .radius_mm();
    return 0.0;
}

}  // namespace

void check_position_offset(const SortedWords& words, const Modal& modal) {
    if (!modal.cutter_is_off()) raise_alarm(42);
    const bool straight = modal.is(ModalGroup::motion, 0) || modal.is(ModalGroup::motion, 10);
    if (!straight && words.has_axis() && !modal.in_cycle()) raise_alarm(9005);
}

offsets::ControlPosition end_of_straight_move(const SortedWords& words, Modal& modal,
                                              const Frames& frames) {
    offsets::ControlPosition end = commanded_position(words, modal, frames);
    const double growth = growth_mm(words, modal, frames);
    if (growth == 0.0) return end;
    for (const ControlAxis& entry : modal.settings.axes) {
        if (entry.rotary || !words.has(entry.axis)) continue;
        const double way = end[entry.axis] - frames.program[entry.axis];
        if (way == 0.0 && modal.absolute()) continue;
        const double sense = way == 0.0 ? words.axis_value(entry.axis) : way;
        end[entry.axis] += std::copysign(1.0, sense) * growth;
    }
    return end;
}

}  // namespace trunnion::controller

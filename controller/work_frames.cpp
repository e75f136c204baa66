// Work coordinate systems: G54-G59, G54.1, G52, G53, G92, G92.1.
#include <fmt/format.h>

#include "controller/g_codes.h"
#include "controller/g_handlers.h"
#include "controller/moves.h"

namespace trunnion {

void g_work_offset(ControlState& c, const GCode& code) {
    if (c.five_axis.tcp) raise_alarm(5421, "(a work offset under it)");
    // G54.1 Pn, and G54 Pn as the same.
    const bool additional =
        code.code10 == 541 || (code.code10 == 540 && c.words.has('P') && !c.words.has('L'));
    if (additional) {
        const int most = static_cast<int>(c.stores.work.additional.size());
        const int p = c.words.has('P') ? c.whole_word('P') : 0;
        if (p < 1 || p > most)
            raise_alarm(31, fmt::format("(G54.1: P is 1 to {})", most), c.words.column_of('P'));
        c.work_number = p;
        c.modal.set(ModalGroup::work_offset, 541);
    } else {
        c.work_number = 0;
        c.modal.set(ModalGroup::work_offset, code.code10);
    }
    c.read_work_offset();
}

void g_local_shift(ControlState& c, const GCode&) {
    for (const ControlAxis& entry : c.config.axes) {
        if (!c.words.has(letter_of(entry.axis))) continue;
        c.coordinates.local[entry.axis] = c.axis_word(entry.axis);  // absolute under G91 too
    }
    c.frame_changed();
}

void g_machine_position(ControlState& c, const GCode&) {
    if (!c.absolute()) return;  // the control ignores G53 under G91
    ControlPosition target = c.machine;
    for (const ControlAxis& entry : c.config.axes)
        if (c.words.has(letter_of(entry.axis))) target[entry.axis] = c.axis_word(entry.axis);
    move_machine(c, MotionKind::rapid, target);
    c.length_parked = true;
}

void g_preset(ControlState& c, const GCode&) {
    if (c.words.has('S')) c.spindle.most_rpm = c.words.get('S');  // the limit of G96
    // The present position gets the coordinates given; G52 of these axes is cancelled; every work
    // coordinate system shifts alike. Inside a tilted plane the shift lies along its axes and ends
    // with it (assumed).
    Coordinates& stages = c.coordinates;
    ControlPosition wanted = c.program;
    for (const ControlAxis& entry : c.config.axes)
        if (c.words.has(letter_of(entry.axis)))
            wanted[entry.axis] = c.axis_word(entry.axis);  // absolute under G91 too
    const ControlPosition from = stages.shaped_from_program(c.program);
    const ControlPosition to = stages.shaped_from_program(wanted);
    for (const ControlAxis& entry : c.config.axes) {
        const Axis axis = entry.axis;
        const bool in_plane = stages.feature_MF && index_of(axis) < 3;
        (in_plane ? stages.local : stages.preset)[axis] += from[axis] - to[axis];
        if (in_plane || !c.words.has(letter_of(axis))) continue;
        stages.preset[axis] += stages.local[axis];
        stages.local[axis] = 0.0;
    }
    c.frame_changed();
}

void g_preset_cancel(ControlState& c, const GCode&) {
    for (const ControlAxis& entry : c.config.axes) {
        if (!c.words.has(letter_of(entry.axis))) continue;
        c.coordinates.preset[entry.axis] = 0.0;
        c.coordinates.local[entry.axis] = 0.0;
    }
    c.frame_changed();
}

}  // namespace trunnion

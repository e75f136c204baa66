// G27 to G30: reference positions (1240-1243) by way of an intermediate point, as rapids.
#include "controller/g_codes.h"
#include "controller/g_handlers.h"
#include "controller/moves.h"

namespace trunnion {

namespace {

/// 1 for G28; P of G30, 2 when it is left out.
int reference_number(const ControlState& c, const GCode& code) {
    if (code.code10 == 280) return 1;
    const int p = c.words.has('P') ? c.whole_word('P') : 2;
    if (p < 2 || p > 4) raise_alarm(46, c.words.column_of('P'));
    return p;
}

void no_cycle(const ControlState& c) {
    if (!c.modal.is(ModalGroup::cycle, 800)) raise_alarm(44);
}

}  // namespace

void g_reference(ControlState& c, const GCode& code) {
    no_cycle(c);
    const std::size_t row = static_cast<std::size_t>(reference_number(c, code) - 1);
    const ControlPosition through = c.target();
    move_line(c, MotionKind::rapid, through);
    ControlPosition target = c.machine;
    for (const ControlAxis& entry : c.config.axes) {
        if (!c.words.has(letter_of(entry.axis))) continue;
        c.intermediate[entry.axis] = through[entry.axis];
        target[entry.axis] = c.settings.reference[row][index_of(entry.axis)];
    }
    move_machine(c, MotionKind::rapid, target);
    c.length_parked = true;
}

void g_from_reference(ControlState& c, const GCode&) {
    no_cycle(c);
    const ControlPosition stood = c.program;
    ControlPosition through = stood;
    for (const ControlAxis& entry : c.config.axes)
        if (c.words.has(letter_of(entry.axis))) through[entry.axis] = c.intermediate[entry.axis];
    move_line(c, MotionKind::rapid, through);
    move_line(c, MotionKind::rapid, c.target());  // G91: counted from the intermediate point
}

void g_reference_check(ControlState& c, const GCode&) {
    no_cycle(c);
    move_line(c, MotionKind::rapid, c.target());
    constexpr double in_position = 0.001;  // mm or deg
    for (const ControlAxis& entry : c.config.axes) {
        if (!c.words.has(letter_of(entry.axis))) continue;
        const double off = c.machine[entry.axis] - c.settings.reference[0][index_of(entry.axis)];
        if (off > in_position || off < -in_position)
            raise_alarm(92, std::string(1, letter_of(entry.axis)),
                        c.words.column_of(letter_of(entry.axis)));
    }
}

}  // namespace trunnion

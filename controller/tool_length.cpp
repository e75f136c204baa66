// G43, G44, G49: tool length compensation, types A, B and C (5001#0, #1), move or shift (5006#6).
#include "controller/tool_length.h"

#include "controller/five_axis.h"
#include "controller/g_codes.h"
#include "controller/g_handlers.h"

namespace trunnion {

namespace {

Axis length_axis(const ControlState& c) {
    if (c.settings.length_axis_type == 0) return Axis::Z;
    if (c.settings.length_axis_type == 1) return plane_axes(c.modal).normal;
    for (const ControlAxis& entry : c.config.axes)  // type C: the axis named in the block
        if (c.words.has(letter_of(entry.axis))) return entry.axis;
    raise_alarm(27);
}

}  // namespace

double tool_length_mm(const ControlState& c, int number) {
    if (number < 0 || number >= static_cast<int>(c.stores.tools.tool.size()))
        raise_alarm(30, c.words.column_of('H'));
    return number == 0 ? 0.0 : c.stores.tools.tool[static_cast<std::size_t>(number)].length_mm();
}

void apply_tool_length(ControlState& c, const ControlPosition& length) {
    const ControlPosition program = c.program;
    const bool parked = c.length_parked;
    c.coordinates.length = length;
    c.frame_changed();
    // Shift type, or the length was left out at the reference position: the position display
    // changes. Otherwise the program position stands and the axis goes to it.
    if (c.settings.length_shifts || parked) return;
    c.program = program;
    c.length_moves = true;
}

void g_tool_length(ControlState& c, const GCode& code) {
    const bool from_tcp = c.five_axis.tcp.has_value();
    cancel_tool_centre(c);
    c.modal.set(ModalGroup::length, code.code10);
    if (c.words.has('H')) c.length_number = c.whole_word('H');
    ControlPosition length;
    if (code.code10 != 490) {
        const double sign = code.code10 == 440 ? -1.0 : 1.0;
        length[length_axis(c)] = sign * tool_length_mm(c, c.length_number);
    }
    c.move.tool_offset = code.code10 == 490 ? 0 : c.length_number;
    c.move.tool_vector_mm = xyz_of(length);
    if (c.five_axis.plane) length = tool_length_in_plane(c);
    apply_tool_length(c, length);
    // G49 of G43.4 moves nothing: the axes stand where the tip was led to (assumed).
    if (from_tcp && code.code10 == 490) {
        c.length_moves = false;
        c.frame_changed();
    }
}

/// H without a code: the other offset in the present way (assumed).
void change_length_number(ControlState& c) {
    const int present = c.modal[ModalGroup::length];
    if (present == 430 || present == 440) return g_tool_length(c, *find_g_code(0.1 * present));
    c.length_number = c.whole_word('H');
    if (c.five_axis.tcp) change_tool_centre_length(c);
}

}  // namespace trunnion

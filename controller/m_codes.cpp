#include "controller/m_codes.h"

#include <fmt/format.h>

#include <algorithm>

#include "controller/dialect_codes.h"

namespace trunnion {

namespace {

/// The M codes this control knows (others are noted once and passed on). Assignments of M codes are
/// the machine builder's; these are the usual ones.
struct MCodeRow {
    int code;
    bool after_motion;
    const char* text;
};
constexpr MCodeRow rows[] = {
    {0, true, "program stop"},
    {1, true, "optional stop"},
    {2, true, "end of program"},
    {3, false, "spindle clockwise"},
    {4, false, "spindle counter-clockwise"},
    {5, true, "spindle stop"},
    {6, false, "tool change"},
    {7, false, "coolant mist"},
    {8, false, "coolant"},
    {9, true, "coolant off"},
    {19, false, "spindle orientation"},
    {29, false, "rigid tapping"},
    {30, true, "end of program, rewind"},
};

const MCodeRow* find_row(int code) {
    const auto it = std::find_if(std::begin(rows), std::end(rows),
                                 [code](const MCodeRow& row) { return row.code == code; });
    return it == std::end(rows) ? nullptr : &*it;
}

const ClampCode* clamp_of(const ControlState& c, int code) {
    for (const ClampCode& clamp : c.config.clamps)
        if (code == clamp.m_clamp || code == clamp.m_release) return &clamp;
    return nullptr;
}

void set_spindle(ControlState& c, int direction) {
    c.spindle.direction = direction;
    c.feed_changed();
}

void change_state(ControlState& c, int code) {
    switch (code) {
        case 2:
        case 30:
            c.ended = true;
            break;
        case 3:
            set_spindle(c, 1);
            break;
        case 4:
            set_spindle(c, -1);
            break;
        case 5:
        case 19:
            set_spindle(c, 0);
            break;
        case 6:
            c.move.tool = c.tool_selected;
            break;
        case 7:
        case 8:
            c.move.coolant = true;
            break;
        case 9:
            c.move.coolant = false;
            break;
        case 29:
            c.cycle.rigid_tap = true;
            break;
        default:
            break;
    }
}

/// These stop the reading ahead: a compensated path ends square before them.
bool stops_reading(int code) {
    return code == 0 || code == 1 || code == 2 || code == 30;
}

void carry_out(ControlState& c, int code) {
    c.last_m = code;
    if (stops_reading(code)) flush_path(c);
    if (code == 0) c.note("M00: program stop, continued");
    if (code == 1 && c.config.optional_stop) c.note("M01: optional stop, continued");
    if (const DialectCode* row = find_dialect_code(c, code)) {
        row->handler(c);
        return queue_m_code(c, code);
    }
    if (const ClampCode* clamp = clamp_of(c, code))
        c.clamped[index_of(clamp->axis)] = code == clamp->m_clamp;
    else if (!find_row(code))
        c.note(fmt::format("M{:02} is not known to the control: passed on without effect", code));
    change_state(c, code);
    queue_m_code(c, code);
}

bool acts_after(const ControlState& c, int code) {
    if (const ClampCode* clamp = clamp_of(c, code)) return code == clamp->m_clamp;
    const MCodeRow* row = find_row(code);
    return row && row->after_motion;
}

void run(ControlState& c, bool after) {
    for (std::size_t i = 0; i < c.words.m_count; ++i) {
        if (acts_after(c, c.words.m[i]) != after) continue;
        c.words.running_column = c.words.m_column[i];
        carry_out(c, c.words.m[i]);
    }
    c.words.running_column = 0;
}

}  // namespace

void m_codes_before(ControlState& c) {
    run(c, false);
}
void m_codes_after(ControlState& c) {
    run(c, true);
}

}  // namespace trunnion

#include "controller/dialect_codes.h"

#include <cmath>

#include "controller/five_axis.h"

namespace trunnion {

namespace {

template <int code>
void five_axis_code(ControlState& c) {
    hurco_m_code(c, code);
}

/// The rotary counters go back into one turn; nothing moves.
void unwind(ControlState& c) {
    ControlPosition machine = c.machine;
    for (const ControlAxis& axis : c.config.axes)
        if (axis.rotary) machine[axis.axis] -= 360.0 * std::floor(machine[axis.axis] / 360.0);
    c.stand_at(machine);
}

void tilt_preference(ControlState& c) {
    c.note("M200 is accepted: the preference of the tilt axis is not emulated");
}

// Source of all rows: VMX 42 SR NC Post Processor Guide v1.2, doc 757-4002-505, contents
// (facts/control.md 2.6). What they do in detail is assumed to be what the like Fanuc code does.
constexpr const char* guide = "Hurco 757-4002-505, contents";
constexpr DialectCode rows[] = {
    {DialectFamily::hurco, 31, unwind, "rotary encoder reset (unwind)", guide},
    {DialectFamily::hurco, 126, five_axis_code<126>, "shortest angular traverse on", guide},
    {DialectFamily::hurco, 127, five_axis_code<127>, "shortest angular traverse off", guide},
    {DialectFamily::hurco, 128, five_axis_code<128>, "tool centre point control on", guide},
    {DialectFamily::hurco, 129, five_axis_code<129>, "tool centre point control off", guide},
    {DialectFamily::hurco, 200, tilt_preference, "tilt axis preference", guide},
};

}  // namespace

std::span<const DialectCode> dialect_codes() {
    return rows;
}

const DialectCode* find_dialect_code(const ControlState& c, int m_code) {
    for (const DialectCode& row : rows)
        if (row.m_code == m_code && row.family == c.config.dialect.family) return &row;
    return nullptr;
}

}  // namespace trunnion

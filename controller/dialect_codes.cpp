#include "controller/dialect_codes.h"

#include <cmath>

#include "controller/alarms.h"
#include "controller/tool_length.h"

namespace trunnion::controller {

namespace {

/// M31: the rotary counters go back into one turn; nothing moves.
void unwind(Modal& modal, Frames& frames, Mover&) {
    offsets::ControlPosition machine = frames.machine;
    for (const ControlAxis& axis : modal.settings.axes)
        if (axis.rotary) machine[axis.axis] -= 360.0 * std::floor(machine[axis.axis] / 360.0);
    frames.stand_at(machine);
}

void tilt_preference(Modal&, Frames&, Mover& mover) {
    mover.note("M200 is accepted: the preference of the tilt axis is not emulated");
}

void shortest_way_on(Modal& modal, Frames&, Mover&) {
    modal.shortest_way = true;
}
void shortest_way_off(Modal& modal, Frames&, Mover&) {
    modal.shortest_way = false;
}

/// M128 takes the tool length in force; its programming frame lies on the table at rotary zero
/// (assumed: the part set-up is a table frame).
void start_management(Modal&, Frames& frames, Mover& mover) {
    const positioning::RotaryTransform& transform = frames.transform(5420);
    if (frames.fixture_number != 0) raise_alarm(5421, "(G54.2 is in force)");
    cancel_tool_centre(frames, mover);
    frames.tip.by_vector = false;
    frames.tip.in_force = motion::ToolCentrePoint::start(
        transform, frames.axes, positioning::TcpFrame::rotary_zero, frames.tool.vector_mm);
    mover.frames_changed();
}

void end_management(Modal&, Frames& frames, Mover& mover) {
    cancel_tool_centre(frames, mover);
}

// Source of all rows: VMX 42 SR NC Post Processor Guide v1.2, doc 757-4002-505, contents. What they
// do in detail is assumed to be what the like Fanuc code does.
constexpr const char* guide = "Hurco 757-4002-505, contents";
constexpr DialectCode rows[] = {
    {interpreter::DialectFamily::hurco, 31, unwind, "rotary encoder reset (unwind)", guide},
    {interpreter::DialectFamily::hurco, 126, shortest_way_on, "shortest angular traverse on",
     guide},
    {interpreter::DialectFamily::hurco, 127, shortest_way_off, "shortest angular traverse off",
     guide},
    {interpreter::DialectFamily::hurco, 128, start_management, "tool centre point control on",
     guide},
    {interpreter::DialectFamily::hurco, 129, end_management, "tool centre point control off",
     guide},
    {interpreter::DialectFamily::hurco, 200, tilt_preference, "tilt axis preference", guide},
};

}  // namespace

const DialectCode* find_dialect_code(interpreter::DialectFamily family, int m_code) {
    for (const DialectCode& row : rows)
        if (row.m_code == m_code && row.family == family) return &row;
    return nullptr;
}

}  // namespace trunnion::controller

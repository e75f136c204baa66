#include "controller/dialect_codes.h"

#include <cmath>

#include "controller/alarms.h"
#include "controller/retract.h"
#include "controller/tool_length.h"

namespace trunnion::controller {

namespace {

/// M31: rotary positions are reduced to one turn, keeping their sign (inferred); no motion.
void unwind(const SortedWords&, Modal& modal, Frames& frames, Mover&) {
    offsets::ControlPosition machine = frames.machine;
    for (const ControlAxis& axis : modal.settings.axes)
        if (axis.rotary) machine[axis.axis] = std::fmod(machine[axis.axis], 360.0);
    frames.stand_at(machine);
}

void prefer_tilt(const SortedWords& words, Modal& modal, Frames&, Mover&) {
    const int p = words.has('P') ? words.whole('P') : 0;
    if (p != 1 && p != 2) raise_alarm(5421, "(M200: P is 1 or 2)", words.column_of('P'));
    modal.tilt = p == 1 ? positioning::Branch::positive : positioning::Branch::negative;
}

void shortest_way_on(const SortedWords&, Modal& modal, Frames&, Mover&) {
    modal.shortest_way = true;
}
void shortest_way_off(const SortedWords&, Modal& modal, Frames&, Mover&) {
    modal.shortest_way = false;
}

/// M128 uses the active tool length. Its programming frame lies on the table at rotary zero
/// (inferred: the part set-up is a table frame).
void start_management(const SortedWords&, Modal&, Frames& frames, Mover& mover) {
    const positioning::RotaryTransform& transform = frames.transform(5420);
    cancel_tool_centre(frames, mover);
    frames.tip.by_vector = false;
    frames.tip.by_angle_or_vector = true;
    frames.tip.in_force = motion::ToolCentrePoint::start(
        transform, frames.axes, positioning::TcpFrame::rotary_zero, frames.tool.vector_mm);
    mover.frames_changed();
}

/// This also ends the linearisation of G43.4 (assumed).
void end_management(const SortedWords&, Modal&, Frames& frames, Mover& mover) {
    cancel_tool_centre(frames, mover);
    frames.tip.along_line = false;
}

/// Length and radius of tool T become active; no motion.
void change_tool(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover) {
    modal.block.tool = modal.number.tool;
    if (!modal.settings.hurco.length_from_tool_change) return;
    const int most = static_cast<int>(frames.stores().tools.tool.size());
    if (modal.number.tool >= most) raise_alarm(30, words.column_of('T'));
    modal.number.length = modal.number.radius = modal.number.tool;
    set_tool_length({}, modal, frames, mover, 430);
}

void one_touch(const SortedWords&, Modal& modal, Frames&, Mover&) {
    modal.touches_twice = false;
}
void two_touches(const SortedWords&, Modal& modal, Frames&, Mover&) {
    modal.touches_twice = true;
}

template <Axis axis, bool on>
void clamp(const SortedWords&, Modal&, Frames&, Mover& mover) {
    mover.axes.clamp(axis, on);
}

[[noreturn]] void refuse(const SortedWords&, Modal&, Frames&, Mover&) {
    raise_alarm(9003);
}

constexpr const char* guide = "Hurco 757-4002-505, contents";
constexpr const char* post = "Autodesk post for Hurco, rev. 45628";
constexpr const char* digest = "second-hand digest of a class workbook";

// The details of these codes are inferred: docs/control.md, "Hurco".
constexpr DialectCode rows[] = {
    {6, false, change_tool, "tool change", post},
    {10, false, nullptr, "second coolant", post},
    {11, false, nullptr, "air through the tool", post},
    {12, true, clamp<Axis::C, true>, "clamp C", post},
    {13, false, clamp<Axis::C, false>, "release C", post},
    {20, false, refuse, "indexer", digest},
    {25, true, go_to_tool_change, "Z to the tool-change height", "Vectric post, 2006"},
    {26, false, nullptr, "part probe", post},
    {27, false, nullptr, "tool probe", post},
    {31, false, unwind, "rotary encoder reset (unwind)", guide},
    {32, true, clamp<Axis::A, true>, "clamp A", post},
    {33, false, clamp<Axis::A, false>, "release A", post},
    {34, true, clamp<Axis::B, true>, "clamp B", post},
    {35, false, clamp<Axis::B, false>, "release B", post},
    {36, true, nullptr, "servos off", digest},
    {41, false, one_touch, "one touch of G31", post},
    {42, false, two_touches, "two touches of G31", post},
    {52, false, nullptr, "output 1 on", digest},
    {53, false, nullptr, "output 2 on", digest},
    {54, false, nullptr, "output 3 on", digest},
    {55, false, nullptr, "output 4 on", digest},
    {56, false, refuse, "pallet", digest},
    {57, false, refuse, "pallet", digest},
    {58, false, refuse, "pallet", digest},
    {59, false, nullptr, "chips forward", post},
    {60, false, nullptr, "chips back", digest},
    {61, false, nullptr, "chips stop", post},
    {62, false, nullptr, "output 1 off", digest},
    {63, false, nullptr, "output 2 off", digest},
    {64, false, nullptr, "output 3 off", digest},
    {65, false, nullptr, "output 4 off", digest},
    {68, false, nullptr, "washdown on", digest},
    {69, false, nullptr, "washdown off", digest},
    {76, false, refuse, "A normal", digest},
    {77, false, refuse, "A reversed", digest},
    {78, false, refuse, "B normal", digest},
    {79, false, refuse, "B reversed", digest},
    {80, false, refuse, "C right-handed", digest},
    {81, false, refuse, "C left-handed", digest},
    {88, false, nullptr, "both coolants", post},
    {126, false, shortest_way_on, "shortest angular traverse on", guide},
    {127, false, shortest_way_off, "shortest angular traverse off", guide},
    {128, false, start_management, "tool centre point control on", guide},
    {129, false, end_management, "tool centre point control off", guide},
    {140, true, retract_along_tool, "retract along the tool", post},
    {200, false, prefer_tilt, "tilt axis preference", guide},
};

}  // namespace

const DialectCode* find_dialect_code(interpreter::DialectFamily family, int m_code) {
    if (family != interpreter::DialectFamily::hurco) return nullptr;
    for (const DialectCode& row : rows)
        if (row.m_code == m_code) return &row;
    return nullptr;
}

}  // namespace trunnion::controller

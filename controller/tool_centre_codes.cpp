// G43.4 and G43.5: start-up, moves of the tip, cancel.
#include <cmath>

#include "controller/feed_time.h"
#include "controller/five_axis.h"
#include "controller/g_codes.h"
#include "controller/g_handlers.h"
#include "controller/tool_length.h"
#include "positioning/rotary_choice.h"

namespace trunnion {

namespace {

constexpr std::uint32_t rotary_letters =
    SortedWords::bit('A') | SortedWords::bit('B') | SortedWords::bit('C');

/// Where the stages put the tip without TCP, mm in M.
Vector3 staged_tip(const ControlState& c, const ControlPosition& machine) {
    return xyz_of(machine) - xyz_of(c.coordinates.length);
}

/// G43.5: rotary angles of the vector I J K (program frame), leaning towards the travel by Q.
void orient_tool(ControlState& c, const Vector3& travel_W, AxisPositions& rotaries) {
    const ToolCentrePoint& tcp = *c.five_axis.tcp;
    const SortedWords& w = c.words;
    const Vector3 vector =
        c.coordinates.linear() * Vector3(w.get('I', 0.0), w.get('J', 0.0), w.get('K', 0.0));
    const int column = w.column_of_first(tool_vector_letters);
    if (vector.norm() < 1e-9) raise_alarm(5421, "(I J K is no direction)", column);
    const Vector3 n_W =
        leaned(tcp.direction_W(vector.normalized()), travel_W, c.five_axis.lean_rad);
    const RotaryChoice choice = choose_rotaries(
        *tcp.transform, n_W, tcp.transform->rotaries(c.move.from), rotary_travel(c));
    if (!choice.chosen) raise_alarm(5421, "(no rotary position for this tool axis)", column);
    rotaries = tcp.transform->with_rotaries(rotaries, *choice.chosen);
}

bool turns(const RotaryTransform& transform, const AxisPositions& from, const AxisPositions& to) {
    return !(transform.rotaries(from) == transform.rotaries(to));
}

void check_tcp_words(const ControlState& c) {
    const bool by_vector = c.five_axis.by_vector;
    const int column = c.words.column_of_first(by_vector ? rotary_letters : tool_vector_letters);
    if (column != 0)
        raise_alarm(5421, by_vector ? "(a rotary word under G43.5)" : "(I J K under G43.4)",
                    column);
}

/// The programmed tip and the axes that carry it there.
struct TipTarget {
    Vector3 start_W, end_W;
    AxisPositions to;
    ControlPosition machine;
};

TipTarget tip_target(ControlState& c, const ControlPosition& target) {
    const ToolCentrePoint& tcp = *c.five_axis.tcp;
    TipTarget out;
    out.machine = c.coordinates.machine_from_program(target);
    out.start_W =
        tcp.tip_W(staged_tip(c, c.coordinates.machine_from_program(c.program)), c.move.from);
    AxisPositions rotaries = axis_positions_of(out.machine);
    const Vector3 staged = staged_tip(c, out.machine);
    if (c.five_axis.by_vector && (c.words.present & tool_vector_letters)) {
        orient_tool(c, tcp.tip_W(staged, rotaries) - out.start_W, rotaries);
        out.machine = control_position_of(rotaries);
    }
    out.end_W = tcp.tip_W(staged, rotaries);
    out.to = tcp.machine(out.end_W, rotaries);
    set_xyz(out.machine, {out.to[Axis::X], out.to[Axis::Y], out.to[Axis::Z]});
    return out;
}

/// Rotaries alone: F counts degrees (19696#6 RFC = 1), or the axes run as fast as they may.
double tcp_feed_length(const ControlState& c, double tip_mm, const ControlPosition& machine) {
    if (tip_mm > 1e-9) return tip_mm;
    if (!c.stores.parameters.bit(19696, 6)) return 0.0;
    double square = 0.0;
    for (const Axis axis : {Axis::A, Axis::B, Axis::C})
        square += std::pow(machine[axis] - c.machine[axis], 2);
    return std::sqrt(square) * c.unit_mm;
}

/// The program position: as commanded, with the angles that a vector led to.
ControlPosition reached(const ControlState& c, ControlPosition target,
                        const ControlPosition& machine) {
    if (!c.five_axis.by_vector) return target;
    const ControlPosition counted = c.coordinates.program_from_machine(machine);
    for (const Axis axis : {Axis::A, Axis::B, Axis::C}) target[axis] = counted[axis];
    return target;
}

}  // namespace

ControlPosition tcp_program_position(const ControlState& c, const ControlPosition& machine) {
    ControlPosition staged = machine;
    set_xyz(staged, c.five_axis.tcp->programmed_tip_M(axis_positions_of(machine)) +
                        xyz_of(c.coordinates.length));
    return c.coordinates.program_from_machine(staged);
}

MoveResult move_tip(ControlState& c, MotionKind kind, const ControlPosition& target) {
    check_tcp_words(c);
    const TipTarget tip = tip_target(c, target);
    const ToolCentrePoint& tcp = *c.five_axis.tcp;
    CurveMove way;
    way.length_mm = (tip.end_W - tip.start_W).norm();
    way.feed_length_mm = tcp_feed_length(c, way.length_mm, tip.machine);
    const ControlPosition program = reached(c, target, tip.machine);
    if (!turns(*tcp.transform, c.move.from, tip.to))
        return move_along(c, kind, program, tip.machine, tip.to, way);
    const TipLine line(tcp, c.move.from, tip.to, tip.start_W, tip.end_W);
    way.curve = &line;
    return move_along(c, kind, program, tip.machine, tip.to, way);
}

namespace {

/// The arc of program coordinates as the table sees it.
ArcPath arc_in_W(const ControlState& c, const ProgramArc& arc, const AxisPositions& rotaries) {
    const ToolCentrePoint& tcp = *c.five_axis.tcp;
    ControlPosition centre = c.program;
    set_xyz(centre, arc.centre);
    const Matrix3& linear = c.coordinates.linear();
    ArcPath out;
    out.centre_mm = tcp.tip_W(staged_tip(c, c.coordinates.machine_from_program(centre)), rotaries);
    const Vector3 tip_of_normal_W =
        tcp.tip_W(staged_tip(c, c.coordinates.machine_from_program(centre)) + (linear * arc.normal),
                  rotaries);
    out.normal = (tip_of_normal_W - out.centre_mm).normalized();
    out.sweep_rad = linear.determinant() < 0.0 ? -arc.sweep_rad : arc.sweep_rad;
    out.turns = turns_of(out.sweep_rad);
    return out;
}

double arc_length(const ArcPath& arc, const Vector3& from, const Vector3& to) {
    const Vector3 radius = from - arc.centre_mm;
    const double bow = radius.cross(arc.normal).norm() * arc.sweep_rad;
    return std::hypot(bow, arc.normal.dot(to - from));
}

/// Standing rotaries: the axes themselves run on the arc.
ArcPath arc_of_axes(const ToolCentrePoint& tcp, const ArcPath& arc_W, const AxisPositions& to) {
    ArcPath out = arc_W;
    const AxisPositions centre = tcp.machine(arc_W.centre_mm, to);
    out.centre_mm = {centre[Axis::X], centre[Axis::Y], centre[Axis::Z]};
    out.normal = tcp.transform->pose_MW(to).rotation * arc_W.normal;
    return out;
}

}  // namespace

bool move_five_axis_arc(ControlState& c, MotionKind kind, const ControlPosition& target,
                        const ProgramArc& arc) {
    if (!c.five_axis.tcp) {
        if (follow_fixture(c, target)) c.coordinates.compile();
        return false;
    }
    if (c.five_axis.by_vector) raise_alarm(5421, "(an arc under G43.5)");
    const TipTarget tip = tip_target(c, target);
    const ToolCentrePoint& tcp = *c.five_axis.tcp;
    const ArcPath path_W = arc_in_W(c, arc, tip.to);
    CurveMove way;
    way.length_mm = way.feed_length_mm = arc_length(path_W, tip.start_W, tip.end_W);
    const TipArc curve(tcp, c.move.from, tip.to, tip.start_W, tip.end_W, path_W);
    if (turns(*tcp.transform, c.move.from, tip.to))
        way.curve = &curve;
    else
        way.arc = arc_of_axes(tcp, path_W, tip.to);
    move_along(c, kind, target, tip.machine, tip.to, way);
    return true;
}

namespace {

/// The plain tool length of G43.4: along the tool with the rotaries at zero.
void compensate_length(ControlState& c, const Vector3& tool_vector_mm) {
    ControlPosition length;
    set_xyz(length, tool_vector_mm);
    c.move.tool_vector_mm = tool_vector_mm;
    c.move.tool_offset = c.length_number;
    if (c.five_axis.plane) length = tool_length_in_plane(c);
    apply_tool_length(c, length);
}

}  // namespace

void g_tool_centre(ControlState& c, const GCode& code) {
    const RotaryTransform& transform = five_axis_transform(c, 5420);
    FiveAxisState& five = c.five_axis;
    const bool by_vector = code.code10 == 435;
    if (by_vector && transform.pivot().frame_follows_work)
        raise_alarm(5459, "(G43.5 with WKP, 19696#5)");
    if (c.fixture_number != 0) raise_alarm(5421, "(G54.2 is in force)");
    if (!c.modal.is(ModalGroup::cutter, 400))
        raise_alarm(5421, "(cutter compensation is in force)");
    if (c.words.has('H')) c.length_number = c.whole_word('H');
    cancel_tool_centre(c);
    const Vector3 tool_vector =
        tool_length_mm(c, c.length_number) * transform.pivot().tool_direction;
    c.modal.set(ModalGroup::length, code.code10);
    compensate_length(c, tool_vector);
    five.by_vector = by_vector;
    five.lean_rad = by_vector ? rad_from_deg(c.words.get('Q', 0.0)) : 0.0;
    five.starting = ToolCentrePoint::start(transform, c.move.from, c.config.tcp_frame, tool_vector);
    five_axis_changed(c);
}

void change_tool_centre_length(ControlState& c) {
    ToolCentrePoint& tcp = *c.five_axis.tcp;
    tcp.tool_vector_mm = tool_length_mm(c, c.length_number) * tcp.transform->pivot().tool_direction;
    compensate_length(c, tcp.tool_vector_mm);
}

void cancel_tool_centre(ControlState& c) {
    if (!c.five_axis.tcp) return;
    c.five_axis.tcp.reset();
    five_axis_changed(c);
    c.frame_changed();
}

}  // namespace trunnion

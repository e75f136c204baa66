#include "controller/tip_mover.h"

#include <cmath>

#include "controller/alarms.h"

namespace trunnion::controller {

namespace {

/// Rotary axes at rest: the arc of the axes themselves.
motion::ArcPath arc_of_axes(const motion::ToolCentrePoint& tcp, const motion::ArcPath& arc_W,
                            const AxisPositions& to) {
    motion::ArcPath out = arc_W;
    const AxisPositions centre = tcp.machine(arc_W.centre_mm, to);
    out.centre_mm = {centre[Axis::X], centre[Axis::Y], centre[Axis::Z]};
    out.normal = tcp.transform->pose_MW(to).rotation * arc_W.normal;
    return out;
}

}  // namespace

void TipMover::check_words() const {
    const TipControl& tip = frames_.tip;
    if (leads_tool(words_, modal_, tip)) {
        if (const int column = words_.column_of_first(rotary_letters))
            raise_alarm(5421, "(a rotary word beside a tool vector)", column);
        return;
    }
    const std::uint32_t wrong = tip.by_vector            ? rotary_letters
                                : tip.by_angle_or_vector ? 0U
                                                         : tool_vector_letters;
    if (const int column = words_.column_of_first(wrong))
        raise_alarm(5421, tip.by_vector ? "(a rotary word under G43.5)" : "(I J K under G43.4)",
                    column);
}

/// The tip according to the stages without TCP, mm in M.
Vector3 TipMover::staged_tip(const offsets::ControlPosition& machine) const {
    return offsets::xyz_of(machine) - offsets::xyz_of(frames_.stages.length);
}

bool TipMover::turns(const AxisPositions& to) const {
    return !(tcp().transform->rotaries(frames_.axes) == tcp().transform->rotaries(to));
}

/// Sets the rotary angles for the vector I J K (program frame); under G43.5 inclined by Q towards
/// the travel.
void TipMover::orient_tool(const Vector3& travel_W, AxisPositions& rotaries) const {
    const Vector3 vector = frames_.stages.linear() * tool_vector(words_);
    const Vector3 n_W =
        motion::leaned(tcp().direction_W(vector.normalized()), travel_W, frames_.tip.lean_rad);
    rotaries = with_tool_along(n_W, words_, modal_, frames_, rotaries);
}

/// Tip position, mm in W, from the program position, so that a move without displacement has length
/// zero.
Vector3 TipMover::start_of_way() const {
    if (frames_.tip.keeps_program)
        return tcp().transform->tip_W(frames_.axes, tcp().tool_vector_mm);
    return tcp().tip_W(staged_tip(frames_.stages.machine_from_program(frames_.program)),
                       frames_.axes);
}

TipMover::TipWay TipMover::way_to(const offsets::ControlPosition& target) const {
    const Coordinates& stages = frames_.stages;
    TipWay out;
    offsets::ControlPosition machine = stages.machine_from_program(target);
    out.start_W = start_of_way();
    AxisPositions rotaries = offsets::axis_positions_of(machine);
    const Vector3 staged = staged_tip(machine);
    if (leads_tool(words_, modal_, frames_.tip)) {
        orient_tool(tcp().tip_W(staged, rotaries) - out.start_W, rotaries);
        machine = offsets::control_position_of(rotaries);
    }
    out.end_W = tcp().tip_W(staged, rotaries);
    out.target.axes = tcp().machine(out.end_W, rotaries);
    const AxisPositions& to = out.target.axes;
    offsets::set_xyz(machine, {to[Axis::X], to[Axis::Y], to[Axis::Z]});
    out.target.machine = machine;
    out.target.program = reached(target, machine);
    return out;
}

bool TipMover::keeps_tip_on_way() const {
    return !frames_.tip.by_angle_or_vector || frames_.tip.along_line ||
           modal_.settings.hurco.m128_keeps_tip_between_ends;
}

/// Rotary axes alone: F counts degrees (19696#6 RFC = 1), or the axes move at maximum speed.
double TipMover::feed_length(double tip_mm, const offsets::ControlPosition& machine) const {
    if (tip_mm > 1e-9) return tip_mm;
    if (!frames_.stores().parameters.bit(19696, 6)) return 0.0;
    double square = 0.0;
    for (const Axis axis : {Axis::A, Axis::B, Axis::C})
        square += std::pow(machine[axis] - frames_.machine[axis], 2);
    return std::sqrt(square) * modal_.units.unit_mm;
}

/// The program position: as commanded, with the angles that follow from a vector.
offsets::ControlPosition TipMover::reached(offsets::ControlPosition target,
                                           const offsets::ControlPosition& machine) const {
    if (!frames_.tip.by_vector && !leads_tool(words_, modal_, frames_.tip)) return target;
    const offsets::ControlPosition counted = frames_.stages.program_from_machine(machine);
    for (const Axis axis : {Axis::A, Axis::B, Axis::C}) target[axis] = counted[axis];
    return target;
}

motion::MoveResult TipMover::line(motion::MotionKind kind, const offsets::ControlPosition& target) {
    check_words();
    const TipWay tip = way_to(target);
    CurveMove way;
    way.length_mm = (tip.end_W - tip.start_W).norm();
    way.feed_length_mm = feed_length(way.length_mm, tip.target.machine);
    if (!turns(tip.target.axes) || !keeps_tip_on_way()) return axes_.along(kind, tip.target, way);
    const motion::TipLine line(tcp(), frames_.axes, tip.target.axes, tip.start_W, tip.end_W);
    way.curve = &line;
    return axes_.along(kind, tip.target, way);
}

/// The arc of program coordinates seen from the table.
motion::ArcPath TipMover::arc_in_W(const ProgramArc& arc, const AxisPositions& rotaries) const {
    offsets::ControlPosition centre = frames_.program;
    offsets::set_xyz(centre, arc.centre);
    const Matrix3& linear = frames_.stages.linear();
    const Vector3 staged = staged_tip(frames_.stages.machine_from_program(centre));
    motion::ArcPath out;
    out.centre_mm = tcp().tip_W(staged, rotaries);
    const Vector3 tip_of_normal_W = tcp().tip_W(staged + (linear * arc.normal), rotaries);
    out.normal = (tip_of_normal_W - out.centre_mm).normalized();
    out.sweep_rad = linear.determinant() < 0.0 ? -arc.sweep_rad : arc.sweep_rad;
    out.turns = motion::turns_of(out.sweep_rad);
    return out;
}

void TipMover::arc(motion::MotionKind kind, const offsets::ControlPosition& target,
                   const ProgramArc& arc) {
    if (frames_.tip.by_vector) raise_alarm(5421, "(an arc under G43.5)");
    const TipWay tip = way_to(target);
    const AxisPositions& to = tip.target.axes;
    const motion::ArcPath path_W = arc_in_W(arc, to);
    CurveMove way;
    way.length_mm = way.feed_length_mm = motion::arc_length_mm(path_W, tip.start_W, tip.end_W);
    const motion::TipArc curve(tcp(), frames_.axes, to, {tip.start_W, tip.end_W, path_W});
    if (turns(to))
        way.curve = &curve;
    else
        way.arc = arc_of_axes(tcp(), path_W, to);
    axes_.along(kind, tip.target, way);
}

}  // namespace trunnion::controller

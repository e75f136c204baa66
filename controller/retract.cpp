#include "controller/retract.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "controller/alarms.h"
#include "controller/commanded.h"

namespace trunnion::controller {

namespace {

motion::MotionKind kind_in_force(const Modal& modal) {
    return modal.is(ModalGroup::motion, 0) ? motion::MotionKind::rapid : motion::MotionKind::linear;
}

/// Direction from tip to spindle, in M; components within rounding are set to zero.
Vector3 tool_direction_M(const Frames& frames, const AxisPositions& axes) {
    if (!frames.believed.transform) return Vector3::UnitZ();
    const positioning::RotaryTransform& transform = *frames.believed.transform;
    const Vector3 direction = transform.pose_MW(axes).rotation * transform.tool_direction_W(axes);
    return direction.unaryExpr([](double v) { return std::abs(v) < 1e-12 ? 0.0 : v; });
}

struct Stroke {
    double min, max;
};

Stroke stroke_of(const motion::AxisLimits& limits, std::size_t i) {
    const double top = limits.max[i];
    const bool open_z = i == index_of(Axis::Z) && std::isinf(top);
    return {limits.min[i], open_z ? 0.0 : top};
}

/// Distance (mm) along the tool until the first axis reaches its limit; 0 when it is already
/// beyond.
double way_to_end(const motion::AxisLimits& limits, const Vector3& at, const Vector3& direction) {
    double way = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) {
        if (direction[k] == 0.0) continue;
        const Stroke stroke = stroke_of(limits, static_cast<std::size_t>(k));
        const double end = direction[k] > 0.0 ? stroke.max : stroke.min;
        way = std::min(way, (end - at[k]) / direction[k]);
    }
    if (std::isinf(way)) raise_alarm(9003, "(M140 and G8.2: no stroke ends the way)");
    return std::max(0.0, way);
}

/// `at` moved along the tool: by L of the block, or to a stroke limit.
Vector3 backed_off(const SortedWords& words, const motion::AxisLimits& limits, const Vector3& at,
                   const Vector3& direction) {
    if (words.has('L')) return at + words.length_mm('L') * direction;
    Vector3 out = at + way_to_end(limits, at, direction) * direction;
    for (int k = 0; k < 3; ++k) {  // rounding must not exceed a stroke limit
        const Stroke stroke = stroke_of(limits, static_cast<std::size_t>(k));
        const double end = std::clamp(out[k], stroke.min, stroke.max);
        if (direction[k] != 0.0 && std::abs(end - out[k]) < 1e-9) out[k] = end;
    }
    return out;
}

void go_to_xyz(const Vector3& at, const Modal& modal, const Frames& frames, Mover& mover) {
    offsets::ControlPosition target = frames.machine;
    offsets::set_xyz(target, at);
    mover.axes.to_machine(kind_in_force(modal), target);
}

/// Direction of I J K in W.
Vector3 commanded_direction_W(const SortedWords& words, const Frames& frames) {
    const Vector3 vector = tool_vector(words).normalized();
    if (frames.tip.in_force)
        return frames.tip.in_force->direction_W(frames.stages.linear() * vector);
    return frames.plane ? Vector3(frames.plane->pose_PF.rotation * vector) : vector;
}

/// Axis positions with the tip on the program position `target` and these rotary positions.
Vector3 end_of(const offsets::ControlPosition& target, const AxisPositions& rotaries,
               const Frames& frames) {
    const Vector3 staged = offsets::xyz_of(frames.stages.machine_from_program(target));
    if (!frames.tip.in_force) return staged;
    const motion::ToolCentrePoint& tcp = *frames.tip.in_force;
    const Vector3 tip_M = staged - offsets::xyz_of(frames.stages.length);
    const AxisPositions end = tcp.machine(tcp.tip_W(tip_M, rotaries), rotaries);
    return {end[Axis::X], end[Axis::Y], end[Axis::Z]};
}

}  // namespace

void retract_along_tool(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover) {
    const Vector3 direction = tool_direction_M(frames, frames.axes);
    go_to_xyz(backed_off(words, mover.axes.limits, offsets::xyz_of(frames.machine), direction),
              modal, frames, mover);
}

void go_to_tool_change(const SortedWords&, Modal& modal, Frames& frames, Mover& mover) {
    const double top_mm = stroke_of(mover.axes.limits, index_of(Axis::Z)).max;
    offsets::ControlPosition target = frames.machine;
    target[Axis::Z] = modal.settings.hurco.tool_change_z_mm.value_or(top_mm);
    mover.axes.to_machine(motion::MotionKind::rapid, target);
}

void reposition(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover) {
    const bool vector = (words.present & tool_vector_letters) != 0;
    if (const int column = words.column_of_first(rotary_letters); vector && column != 0)
        raise_alarm(5421, "(a rotary word beside a tool vector)", column);
    frames.transform(5420);
    const offsets::ControlPosition target = commanded_position(words, modal, frames);
    AxisPositions rotaries = offsets::axis_positions_of(frames.stages.machine_from_program(target));
    if (vector)
        rotaries =
            with_tool_along(commanded_direction_W(words, frames), words, modal, frames, rotaries);
    const motion::AxisLimits& limits = mover.axes.limits;
    retract_along_tool(words, modal, frames, mover);
    offsets::ControlPosition turned = offsets::control_position_of(rotaries);
    offsets::set_xyz(turned, offsets::xyz_of(frames.machine));
    mover.axes.to_machine(kind_in_force(modal), turned);
    if (frames.plane) {
        frames.place_plane();
        mover.frames_changed();
    }
    const Vector3 end = end_of(target, rotaries, frames);
    const Vector3 direction = tool_direction_M(frames, frames.axes);
    go_to_xyz(backed_off(words, limits, end, direction), modal, frames, mover);
    go_to_xyz(end, modal, frames, mover);
}

}  // namespace trunnion::controller

// Positions in the units of the control: by axis letter, mm and deg. They become rad on output.
#pragma once

#include "base/units.h"
#include "geometry/axes.h"
#include "geometry/pose.h"
#include "offsets/stores.h"

namespace trunnion::offsets {

/// mm for linear axes, deg for rotary axes, so that a typed value reads back as the same double.
using ControlPosition = OffsetVector;

inline Vector3 xyz_of(const ControlPosition& p) {
    return {p[Axis::X], p[Axis::Y], p[Axis::Z]};
}
inline void set_xyz(ControlPosition& p, const Vector3& xyz) {
    p[Axis::X] = xyz.x();
    p[Axis::Y] = xyz.y();
    p[Axis::Z] = xyz.z();
}

/// Converts deg to rad; mm are unchanged.
inline AxisPositions axis_positions_of(const ControlPosition& p) {
    AxisPositions out;
    for (std::size_t i = 0; i < axis_count; ++i) out.value[i] = p.value[i];
    for (const Axis axis : {Axis::A, Axis::B, Axis::C}) out[axis] = rad_from_deg(p[axis]);
    return out;
}
inline ControlPosition control_position_of(const AxisPositions& p) {
    ControlPosition out;
    for (std::size_t i = 0; i < axis_count; ++i) out.value[i] = p.value[i];
    for (const Axis axis : {Axis::A, Axis::B, Axis::C}) out[axis] = deg_from_rad(p[axis]);
    return out;
}

}  // namespace trunnion::offsets

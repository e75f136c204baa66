// I J K as a tool direction: G43.5, and M128 and G8.2 of a Hurco.
#pragma once

#include "controller/frames.h"

namespace trunnion::controller {

/// I J K: tool axis direction, from tip to spindle.
constexpr std::uint32_t tool_vector_letters =
    SortedWords::bit('I') | SortedWords::bit('J') | SortedWords::bit('K');
constexpr std::uint32_t rotary_letters =
    SortedWords::bit('A') | SortedWords::bit('B') | SortedWords::bit('C');

/// The direction as written, not normalised. PS5421 for a zero vector.
Vector3 tool_vector(const SortedWords& words);
/// `axes` with rotary positions that point the tool along the unit vector n_W: shortest move from
/// the present positions; on a Hurco the tilt preferred by M200, else the other one. PS5421 when
/// there is none within travel.
AxisPositions with_tool_along(const Vector3& n_W, const SortedWords& words, const Modal& modal,
                              const Frames& frames, const AxisPositions& axes);

/// True when I J K of this block give the tool direction. Under M128 I J K of an arc are its centre
/// and I of a cycle is its depth.
bool leads_tool(const SortedWords& words, const Modal& modal, const TipControl& tip);

}  // namespace trunnion::controller

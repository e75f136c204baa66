// I J K as a direction of the tool: G43.5, and M128 and G8.2 of a Hurco.
#pragma once

#include "controller/frames.h"

namespace trunnion::controller {

/// I J K: the tool axis, from the tip to the spindle.
constexpr std::uint32_t tool_vector_letters =
    SortedWords::bit('I') | SortedWords::bit('J') | SortedWords::bit('K');
constexpr std::uint32_t rotary_letters =
    SortedWords::bit('A') | SortedWords::bit('B') | SortedWords::bit('C');

/// The direction as written, of any length. PS5421 when it is none.
Vector3 tool_vector(const SortedWords& words);
/// `axes` with the rotaries that point the tool along unit vector n_W: the nearest way from where
/// they stand, on a Hurco the tilt that M200 prefers and else the other one. PS5421 when there are
/// none within travel.
AxisPositions with_tool_along(const Vector3& n_W, const SortedWords& words, const Modal& modal,
                              const Frames& frames, const AxisPositions& axes);

/// Do I J K of this block lead the tool? Under M128 those of an arc are its centre and I of a cycle
/// is its depth.
bool leads_tool(const SortedWords& words, const Modal& modal, const TipControl& tip);

}  // namespace trunnion::controller

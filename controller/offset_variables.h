// Variables of the offset stores: #2001.. tools, #5201.. work offsets, #5521.. fixture offsets.
#pragma once

#include <optional>

#include "controller/mover.h"

namespace trunnion::controller {

/// Empty when the number belongs to no store. Lengths in the active unit (G20: inch).
std::optional<double> offset_variable(int number, const Modal& modal, Frames& frames);
/// False when the number belongs to no store. Work and fixture offsets act immediately.
bool set_offset_variable(int number, double value, const Modal& modal, Frames& frames,
                         Mover& mover);

}  // namespace trunnion::controller

// A tracker or a CMM reads the position of a target (`point` rows of formats.md, "Readings").
#pragma once

#include "emulator/instruments.h"

namespace trunnion::emulator {

/// dir . (p_measured - T p_commanded), mm. p_measured is the reading of the physical target,
/// including pose and scale errors of the instrument.
double point_mm(const InstrumentView& view);

/// Fills instrument, direction and commanded position of the contact of a point row. The commanded
/// position is that of the target on the error-free machine where the declared control believes it,
/// seen from the declared pose of the instrument; the direction in M follows the pose error of the
/// setup, too.
/// Throws InputError without position when the row names no instrument of the setup, or when it
/// names none and there are several.
void aim_at_point(const setup::Setup& setup, const records::Reading& row, Contact& contact);

}  // namespace trunnion::emulator

// A tracker or a CMM reads the place of a target (`point` rows of formats.md, "Readings").
#pragma once

#include "emulator/instruments.h"

namespace trunnion::emulator {

/// dir . (p_measured - T p_commanded), mm: p_measured as the instrument reads the physical target,
/// its pose and scale errors included.
double point_mm(const InstrumentView& view);

/// Fills instrument, direction and commanded place of a point row's contact. The commanded place is
/// the target's on the machine without errors, where the declared control believes it. Throws
/// InputError without a place when the row names no instrument of the setup, or none of several.
void aim_at_point(const setup::Setup& setup, const records::Reading& row, Contact& contact);

}  // namespace trunnion::emulator

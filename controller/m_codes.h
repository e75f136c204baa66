// M codes: what they change in the control, and whether they act before or after the motion.
#pragma once

#include "controller/control_state.h"

namespace trunnion {

/// M3 M4 M5?, tool change, coolant, releases: all that acts before the motion of the block.
void m_codes_before(ControlState& c);
/// M0 M1 M2 M30 M5 M9 and clamps: after the motion.
void m_codes_after(ControlState& c);

}  // namespace trunnion

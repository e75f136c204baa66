// The physical tip of the tool in the spindle, independent of the control's belief.
#pragma once

#include "emulator/observer.h"
#include "motion/motion.h"

namespace trunnion::emulator {

/// Length of tool T from gauge point to tip, mm, as [tools] or else offset T of the setup says; 0
/// for a tool that the setup does not know.
double tool_length_mm(const setup::Setup& setup, int tool);

/// The physical tip in S during a move: the stylus when the setup's probe is in the spindle, else
/// tool T, as long as [tools] or else offset T of the setup says, whatever H is in force. A tool
/// that the setup does not know (none called, no length) is as long as the control believes. It
/// points along Z of S, or as 19697 says: [machine] has no key for the spindle's direction.
Vector3 physical_tip_S(const setup::Setup& setup, const motion::AxisMove& move,
                       double extension_mm = 0.0);

/// Contact for effects of the tool when no device reads but the tip is evaluated.
Contact tip_contact(const setup::Setup& setup, const motion::AxisMove& move);

/// Position of that tip in W, mm, effects included.
Vector3 physical_tip_W(const PhysicalState& state, const Vector3& tip_S_mm);

}  // namespace trunnion::emulator

// The axes as the control has them: those of the chain that NC words address, followed by the
// auxiliary axes.
#pragma once

#include <vector>

#include "offsets/axis_compensation.h"
#include "setup/setup.h"

namespace trunnion::setup {

/// Letters of the chain in the order of their slots, then the auxiliary axes: a machine keeps its
/// axis numbers when one is added.
std::vector<kinematics::AxisGeometry> control_axes(const Setup& setup);
/// Chain and auxiliary axes, names that no NC word addresses too: those that have a position.
std::vector<kinematics::AxisGeometry> all_machine_axes(const Setup& setup);
/// What the control adds to their positions (1851, pitch data).
std::vector<offsets::AxisCompensation> compensated_axes(const Setup& setup);
/// Letters of axes whose backlash or pitch the control compensates while the machine of the setup
/// has no such error, so that the compensation causes an error.
std::string overcompensated_axes(const Setup& setup);

}  // namespace trunnion::setup

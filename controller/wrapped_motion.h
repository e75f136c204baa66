// G12.1 and G7.1: figures programmed on a plane that a rotary axis rolls up or turns.
#pragma once

#include "controller/control_state.h"
#include "controller/moves.h"

namespace trunnion {

/// Polar coordinate interpolation in force: a linear axis is the radius, a rotary axis the angle.
/// Program words: the linear axis in mm, the rotary letter in mm too (the hypothetical axis).
void move_polar(ControlState& c);
/// Cylindrical interpolation in force: the rotary axis counts as a length of radius * angle.
/// Straight lines are straight for the axes as well: only their time differs.
void move_cylinder_line(ControlState& c);
void move_cylinder_arc(ControlState& c, bool clockwise);

}  // namespace trunnion

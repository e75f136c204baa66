// G96: the spindle turns so that the cut passes the tool's edge at one speed, whatever the radius.
#pragma once

#include "controller/control_state.h"

namespace trunnion {

/// S of the block: spindle speed, or surface speed under G96.
void take_s_word(ControlState& c, double s);
/// Spindle speed, and under G95 the feed, of a move that ends at `target`; the speed is that of the
/// end. Only under G96.
void follow_surface_speed(ControlState& c, const ControlPosition& target);

}  // namespace trunnion

// G16: the first plane word is a radius, the second an angle.
#pragma once

#include "controller/position.h"

namespace trunnion {

struct ControlState;

/// The position commanded by this block's words under G16. With G90 the pole is the zero of the
/// coordinates, with G91 the present position; each word absolute or incremental as written.
ControlPosition polar_target(ControlState& c);
/// At G16: the angle in force is that of the present position.
void start_polar_words(ControlState& c);

}  // namespace trunnion

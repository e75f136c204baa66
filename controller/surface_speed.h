// G96: constant surface speed at the cutting edge.
#pragma once

#include "controller/modal.h"
#include "offsets/control_position.h"

namespace trunnion::controller {

/// S of the block: spindle speed, or surface speed under G96. `position`: program coordinates.
void take_s_word(Modal& modal, double s, const offsets::ControlPosition& position);
/// G96, G97. G97 without S keeps the speed reached under G96; G96 without S uses its last S. PS0190
/// when P is not a linear axis.
void set_speed_mode(const SortedWords& words, Modal& modal, int code10,
                    const offsets::ControlPosition& position);
/// Under G96 only: spindle speed, and under G95 the feed, of a move between two program positions.
/// The speed is that of the end position.
void follow_surface_speed(Modal& modal, const offsets::ControlPosition& from,
                          const offsets::ControlPosition& to);

}  // namespace trunnion::controller

// G96: the spindle turns so that the cut passes the tool's edge at one speed, whatever the radius.
#pragma once

#include "controller/modal.h"
#include "offsets/control_position.h"

namespace trunnion::controller {

/// S of the block: spindle speed, or surface speed under G96. `position`: program coordinates.
void take_s_word(Modal& modal, double s, const offsets::ControlPosition& position);
/// G96, G97. G97 without S keeps the speed that G96 had reached; G96 without S takes its last one.
/// PS0190 when P names no linear axis.
void set_speed_mode(const SortedWords& words, Modal& modal, int code10,
                    const offsets::ControlPosition& position);
/// Spindle speed, and under G95 the feed, of a move between two program positions; the speed is
/// that of the end. Only under G96.
void follow_surface_speed(Modal& modal, const offsets::ControlPosition& from,
                          const offsets::ControlPosition& to);

}  // namespace trunnion::controller

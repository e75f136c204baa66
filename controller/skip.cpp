// G31: a straight move that ends where the skip signal comes; the place is latched in #5061...
#include "controller/g_codes.h"
#include "controller/g_handlers.h"
#include "controller/moves.h"
#include "controller/system_variables.h"

namespace trunnion {

void g_skip(ControlState& c, const GCode&) {
    if (!c.modal.is(ModalGroup::cutter, 400)) raise_alarm(36);
    c.move.until_skip = true;
    const MoveResult result = move_line(c, MotionKind::linear, c.target());
    c.move.until_skip = false;
    c.skip.triggered = result.skipped;
    c.skip.work = work_position(c);
}

}  // namespace trunnion

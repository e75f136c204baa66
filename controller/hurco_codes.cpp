// Hurco M codes of five-axis machining: M128/M129 tool centre point management, M126/M127 shortest
// way.
#include "controller/five_axis.h"

namespace trunnion {

namespace {

/// M128 takes the tool length in force; its programming frame lies on the table at rotary zero
/// (assumed: the part set-up is a table frame).
void start_management(ControlState& c) {
    const RotaryTransform& transform = five_axis_transform(c, 5420);
    if (c.fixture_number != 0) raise_alarm(5421, "(G54.2 is in force)");
    cancel_tool_centre(c);
    c.five_axis.by_vector = false;
    c.five_axis.tcp = ToolCentrePoint::start(transform, c.move.from, TcpFrame::rotary_zero,
                                             c.move.tool_vector_mm);
    five_axis_changed(c);
    c.frame_changed();
}

}  // namespace

bool hurco_m_code(ControlState& c, int code) {
    switch (code) {
        case 126:
        case 127:
            c.five_axis.shortest_way = code == 126;
            return true;
        case 128:
            start_management(c);
            return true;
        case 129:
            cancel_tool_centre(c);
            return true;
        default:
            return false;
    }
}

}  // namespace trunnion

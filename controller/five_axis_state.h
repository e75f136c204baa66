// What the five-axis functions keep between blocks: part of the control's state.
#pragma once

#include <optional>

#include "base/alarm.h"
#include "motion/tool_centre_point.h"
#include "positioning/fixture_offset.h"
#include "positioning/rotary_transform.h"
#include "positioning/tilted_plane.h"

namespace trunnion {

/// A tilted working plane in force.
struct TiltedPlaneState {
    Pose pose_PF;           ///< feature frame seen from the work frame (table frame, G54 and so on)
    int nesting = 1;        ///< G68.2, and how many G68.4 on top
    AxisPositions latched;  ///< where the axes stood when the frame was laid into the machine
};

struct FiveAxisState {
    std::optional<RotaryTransform> transform;  ///< nothing: 19680 = 0, or `fault`
    std::optional<Alarm> fault;                ///< what is wrong with the parameters, thrown on use
    std::optional<FixtureSettings> fixture;    ///< decoded when G54.2 is first used
    std::optional<TiltedPlaneState> plane;
    PlaneDefinition definition;               ///< of P2 and P3, block by block
    int definition_code10 = 0;                ///< 682 or 684 while it is pending
    std::optional<ToolCentrePoint> tcp;       ///< G43.4, G43.5 in force
    std::optional<ToolCentrePoint> starting;  ///< takes over at the end of the start-up block
    bool by_vector = false;                   ///< G43.5: I J K instead of rotary words
    bool shortest_way = false;                ///< M126: rotary words by the shorter way
    double lean_rad = 0.0;                    ///< Q of G43.5
    /// True while any of these needs the hooks below: the one flag that plain blocks look at.
    bool active = false;
};

}  // namespace trunnion

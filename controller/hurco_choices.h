// What a Hurco does that differs from shop to shop, or that no public source settles: switches.
#pragma once

#include <optional>

#include "positioning/rotary_choice.h"

namespace trunnion::controller {

/// Keys of [control.hurco]. Sources of the defaults: docs/control.md, "Hurco".
struct HurcoChoices {
    bool bnc = false;  ///< nc = "bnc": G70 G71, cycles by positive distances; false: ISNC
    bool length_from_tool_change = true;   ///< M6 puts the length of tool T in force, G43 stands
    bool g49_keeps_tool_length = false;    ///< G49 leaves the length of the tool from M6 in force
    bool rapids_are_interpolated = false;  ///< false: a dogleg, each axis at its own speed
    bool m128_keeps_tip_between_ends = false;  ///< false: only G43.4 leads the tip along its way
    bool planes_stack = true;                  ///< G68.2 inside G68.2 counts from the plane before
    bool g68_2_moved_axes = false;  ///< A B C about moved axes (then G68.3 about fixed ones)
    bool g86_feeds_out = true;      ///< ISNC
    bool g98_feeds_from_r = true;   ///< BNC: the feed starts at R, false: where the cycle began
    bool clamps_alarm = false;      ///< a move of an axis that M12, M32, M34 clamped is an alarm
    positioning::Branch tilt = positioning::Branch::negative;  ///< before the first M200
    double back_off_mm = 1.0;                                  ///< M42: between the touches of G31
    double second_touch_feed = 0.1;                            ///< M42: of the first touch's feed
    std::optional<double> tool_change_z_mm;  ///< M25, machine; nothing: the upper end of Z

    bool operator==(const HurcoChoices&) const = default;
};

}  // namespace trunnion::controller

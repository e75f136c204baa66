// Options for behaviour of a Hurco that differs between shops or that no public source settles.
#pragma once

#include <optional>

#include "positioning/rotary_choice.h"

namespace trunnion::controller {

/// Keys of [control.hurco]. Sources of the defaults: docs/control.md, "Hurco".
struct HurcoChoices {
    bool bnc = false;  ///< nc = "bnc": G70 G71, cycles with positive distances; false: ISNC
    bool length_from_tool_change = true;   ///< M6 activates the length of tool T, as G43 would
    bool g49_keeps_tool_length = false;    ///< after G49 the length of the tool from M6 remains
                                           ///< active
    bool rapids_are_interpolated = false;  ///< false: each axis at its own speed (not interpolated)
    bool m128_keeps_tip_between_ends = false;  ///< false: only G43.4 keeps the tip on its path
                                               ///< between the ends
    bool planes_stack = true;                  ///< G68.2 inside G68.2 refers to the previous plane
    bool g68_2_moved_axes = false;  ///< A B C of G68.2 about moved axes (then G68.3 about fixed
                                    ///< axes)
    bool g86_feeds_out = true;      ///< ISNC
    bool g98_feeds_from_r = true;   ///< BNC: feed starts at R; false: at the level where the cycle
                                    ///< began
    bool clamps_alarm = false;      ///< alarm for a move of an axis clamped by M12, M32, M34
    positioning::Branch tilt = positioning::Branch::negative;  ///< until the first M200
    double back_off_mm = 1.0;                                  ///< M42: retract between the touches
                                                               ///< of G31
    double second_touch_feed = 0.1;                            ///< M42: ratio to the feed of the
                                                               ///< first touch
    std::optional<double> tool_change_z_mm;  ///< M25, machine coordinate; empty: upper end of Z

    bool operator==(const HurcoChoices&) const = default;
};

}  // namespace trunnion::controller

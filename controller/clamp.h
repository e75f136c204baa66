// Axis clamps as the machine builder wired them to M codes.
#pragma once

#include "geometry/axes.h"

namespace trunnion::controller {

/// M codes that clamp and release an axis. `alarm`: moving the clamped axis raises an alarm.
struct ClampCode {
    Axis axis = Axis::C;
    int m_clamp = 10;
    int m_release = 11;
    bool alarm = false;
};

/// Hurco: the code that clamps; the code after it releases.
struct HurcoClamp {
    Axis axis;
    int m_clamp;
};
constexpr HurcoClamp hurco_clamps[] = {{Axis::C, 12}, {Axis::A, 32}, {Axis::B, 34}};

}  // namespace trunnion::controller

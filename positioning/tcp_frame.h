// The programming frame of tool centre point control.
#pragma once

namespace trunnion::positioning {

/// To what the table-fixed frame of G43.4 is tied when it comes with the table turned
/// (docs/five_axis.md: depends on options).
enum class TcpFrame : unsigned char {
    start,       ///< the work frame as it lies then sticks to the table (15i manual)
    rotary_zero  ///< the work frame lies on the table with its rotaries at zero
};

}  // namespace trunnion::positioning

// The programming frame of tool centre point control.
#pragma once

namespace trunnion::positioning {

/// The table-fixed programming frame of G43.4 when it starts with the table turned
/// (docs/five_axis.md: depends on options).
enum class TcpFrame : unsigned char {
    start,       ///< the work frame in its present position is fixed to the table (15i manual)
    rotary_zero  ///< the work frame is fixed to the table as it lies with the rotary axes at zero
};

}  // namespace trunnion::positioning

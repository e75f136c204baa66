// What the control itself adds to the position of each axis: backlash compensation (1851) and
// stored pitch error compensation (3620-3625 and the data from 10000 on).
#pragma once

#include <optional>
#include <vector>

#include "geometry/axes.h"
#include "offsets/stores.h"

namespace trunnion::offsets {

/// In axis units: mm, or rad of a rotary axis.
struct AxisCompensation {
    Axis axis = Axis::X;
    /// At a reversal the axis is sent this far further in its new direction: half of it to either
    /// side of the middle (a control counts it from the side of the reference position, which
    /// differs by a constant). Positive for a drive that lags.
    double backlash = 0.0;
    std::vector<double> at;     ///< machine positions of the pitch table, rising; empty: none
    std::vector<double> value;  ///< added there; linear between (assumed), held beyond the ends
    double turn = 0.0;          ///< of a rotary axis: the table repeats after it; 0: it does not

    double pitch(double position) const;
    double at_position(double position, int side) const {
        return pitch(position) + 0.5 * side * backlash;
    }
};

/// One entry for each axis of `order` that is compensated. The data are in detection units: the
/// least increment (1013#1 ISC, 1001#0 INM) divided by the command multiplier CMR of 1820; those of
/// the pitch table are the steps from point to point, times 3623 (assumed).
std::vector<AxisCompensation> decode_compensation(const Parameters& parameters,
                                                  const std::vector<Axis>& order);

}  // namespace trunnion::offsets

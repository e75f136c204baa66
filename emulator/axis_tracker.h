// What the axes did so far: direction of travel and distance since they turned.
#pragma once

#include "geometry/axes.h"

namespace trunnion {

/// Follows the axes from position to position, in steps small enough that no axis turns twice in
/// one.
class AxisTracker {
  public:
    void place(const AxisPositions& position) { last_ = position; }
    void advance(const AxisPositions& position);

    const AxisPositions& position() const { return last_; }
    /// Copies travel (sign of the last motion, 0 before the first) and since_reversal.
    void describe(AxisSample& sample) const;

  private:
    AxisPositions last_, turned_at_;
    std::array<signed char, axis_count> travel_{};
    std::array<bool, axis_count> has_turned_{};
};

}  // namespace trunnion

// What the axes did so far: direction of travel and distance since they turned.
#pragma once

#include "geometry/axes.h"
#include "motion/motion.h"

namespace trunnion {

/// Less motion than this (mm or rad) is rounding of an axis that stands.
constexpr double standing = 1e-9;

/// Follows the axes from position to position, in steps small enough that no axis turns twice in
/// one.
class AxisTracker {
  public:
    void place(const AxisPositions& position) { last_ = position; }
    void advance(const AxisPositions& position);
    /// Along a move to its end: axes that turn round on an arc or curve are seen to.
    void follow(const AxisMove& move);

    const AxisPositions& position() const { return last_; }
    /// Sign of the last motion, 0 before the first.
    const std::array<signed char, axis_count>& travel() const { return travel_; }
    /// Copies travel and since_reversal.
    void describe(AxisSample& sample) const;

  private:
    void advance(std::size_t i, double value);
    static bool turns_in_plane(const AxisMove& move);
    void follow_turns(const AxisMove& move);

    AxisPositions last_, turned_at_;
    std::array<signed char, axis_count> travel_{};
    std::array<bool, axis_count> has_turned_{};
};

}  // namespace trunnion

// The one history of travel: the side from which each axis came, and how far it went since it
// turned.
#pragma once

#include "geometry/axis_names.h"

namespace trunnion::records {

/// since_reversal of an axis that nobody saw turning: more than this (mm or rad).
constexpr double no_reversal_seen = 1e6;

/// Less motion than this is the rounding of an axis that stands.
struct Rounding {
    double mm = 0.0, rad = 0.0;
};
/// Readings are written with six decimals, mm and deg.
extern const Rounding rows_rounding;
/// Of positions that are not written.
constexpr Rounding path_rounding{1e-9, 1e-9};

/// Follows the axes from position to position. The side of an axis is the sign of its last motion;
/// an axis that stands keeps it. The distance since reversal counts from where the axis turned; it
/// begins anew where the way between two positions is not known.
class TravelHistory {
  public:
    /// `before`: sides before the first motion, 0 where nothing tells them.
    explicit TravelHistory(const AxisSides& before = {}, const Rounding& rounding = path_rounding,
                           const AxisNames& names = {});

    /// The axes stand here, however they came.
    void place(const AxisPositions& position);
    /// They went here, no axis turning on the way. `turned_at`: where axes that turned at the last
    /// position really did; nullptr: there. The first position ever is that of `place`.
    void advance(const AxisPositions& position, const AxisPositions* turned_at = nullptr);
    void advance(std::size_t axis, double value, const double* turned_at = nullptr);
    /// What went before says nothing about reversals; sides stay.
    void begin_anew();
    /// The axis stands at a turning point; whether it came there from the other side is not known.
    void assume_turned(std::size_t axis);

    bool placed() const { return placed_; }
    /// No axis moved since `begin_anew`.
    bool begun() const { return direction_ == AxisSides{}; }
    /// Less motion than this is none, mm or rad.
    double rounding(std::size_t axis) const { return rounding_[axis]; }
    const AxisPositions& position() const { return last_; }
    const AxisSides& travel() const { return side_; }
    /// The axis turned with the last motion.
    bool just_turned(std::size_t axis) const { return just_turned_[axis]; }
    /// Fills travel, since_reversal and run_up_unknown.
    void describe(AxisSample& sample) const;

  private:
    std::array<double, axis_count> rounding_{};
    AxisSides side_{}, direction_{};  ///< direction: since `begin_anew`
    AxisPositions last_, turned_at_;
    std::array<bool, axis_count> turned_{}, just_turned_{}, run_up_unknown_{};
    bool placed_ = false;
};

}  // namespace trunnion::records

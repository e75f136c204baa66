// The history of travel: from which side each axis arrived, and its distance since reversal.
#pragma once

#include "geometry/axis_names.h"

namespace trunnion::records {

/// since_reversal of an axis whose reversal was not observed is larger than this (mm or rad).
constexpr double no_reversal_seen = 1e6;

/// Smaller motion is rounding of an axis at rest.
struct Rounding {
    double mm = 0.0, rad = 0.0;
};
/// For readings, which are written with six decimals, mm and deg.
extern const Rounding rows_rounding;
/// For positions that are not written to a file.
constexpr Rounding path_rounding{1e-9, 1e-9};

/// Follows the axes from position to position. The side of an axis is the sign of its last motion
/// and is kept at rest. The distance since reversal starts at the reversal point; it restarts where
/// the path between two positions is unknown.
class TravelHistory {
  public:
    /// `before`: sides before the first motion, 0 where unknown.
    explicit TravelHistory(const AxisSides& before = {}, const Rounding& rounding = path_rounding,
                           const AxisNames& names = {});

    /// Sets the positions; the path to them is unknown.
    void place(const AxisPositions& position);
    /// Moves to the position without reversal on the way. `turned_at`: actual reversal points of
    /// axes that reversed at the last position; nullptr: that position. The first position must be
    /// set by `place`.
    void advance(const AxisPositions& position, const AxisPositions* turned_at = nullptr);
    void advance(std::size_t axis, double value, const double* turned_at = nullptr);
    /// Forgets reversals; sides are kept.
    void begin_anew();
    /// The axis is at a reversal point; whether it arrived there from the other side is unknown.
    void assume_turned(std::size_t axis);

    bool placed() const { return placed_; }
    /// True when no axis has moved since `begin_anew`.
    bool begun() const { return direction_ == AxisSides{}; }
    /// Smaller motion counts as none, mm or rad.
    double rounding(std::size_t axis) const { return rounding_[axis]; }
    const AxisPositions& position() const { return last_; }
    const AxisSides& travel() const { return side_; }
    /// The axis reversed with the last motion.
    bool just_turned(std::size_t axis) const { return just_turned_[axis]; }
    /// Sets travel, since_reversal and run_up_unknown.
    void describe(AxisSample& sample) const;

  private:
    std::array<double, axis_count> rounding_{};
    AxisSides side_{}, direction_{};  ///< direction: since `begin_anew`
    AxisPositions last_, turned_at_;
    std::array<bool, axis_count> turned_{}, just_turned_{}, run_up_unknown_{};
    bool placed_ = false;
};

}  // namespace trunnion::records

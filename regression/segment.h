// One piece of a path for comparison: a line or an arc, with feed, spindle, coolant, tool.
#pragma once

#include <array>
#include <cstdint>

#include "geometry/pose.h"

namespace trunnion::regression {

/// Kind of a segment. A jump is no motion: the believed tip changes its position (G43, G49).
enum class SegmentKind : std::uint8_t { origin, rapid, feed, jump };

/// A point of a path with orientation. Layer `path`: believed tip (mm) and unit vector from tip to
/// spindle, both in the table frame W. Layer `axes`: X Y Z of the gauge point (mm, machine) and the
/// positions of the first three rotary axes (rad).
struct PathPoint {
    Vector3 position_mm = Vector3::Zero();
    Vector3 orientation = Vector3::Zero();
};

/// One segment, from the end of the previous one to `end`. Plain data, written unchanged to a
/// temporary file. An arc has sweep_rad != 0; a helix rises linearly from start to end.
struct Segment {
    std::array<double, 3> end_mm{};
    std::array<double, 3> end_orientation{};
    std::array<double, 3> centre_mm{};
    std::array<float, 3> normal{};
    float feed_mm_min = 0.0F;   ///< 0 for rapids
    double sweep_rad = 0.0;     ///< counter-clockwise seen from the tip of the normal
    float spindle_rpm = 0.0F;   ///< negative: M4
    std::uint32_t line = 0;     ///< from 1; 0: none (goldens)
    std::uint16_t program = 0;  ///< index into PathRecord::programs
    std::uint16_t tool = 0;
    SegmentKind kind = SegmentKind::rapid;
    std::uint8_t mode = 0;  ///< active PositioningMode
    bool coolant : 1 = false;
    bool turning : 1 = false;  ///< rotary axes move in this segment
    bool timed : 1 = false;    ///< its feed follows from length and time: G93, or moving rotary
                               ///< axes

    PathPoint end() const { return {Vector3(end_mm.data()), Vector3(end_orientation.data())}; }
    bool is_arc() const { return sweep_rad != 0.0; }
};

/// Tolerances of a comparison. Two paths are equal if both can be traversed monotonically such that
/// position and orientation never differ by more than these (Frechet distance); their division into
/// blocks does not matter.
struct Tolerances {
    double position_mm = 0.005;
    double direction_rad = 1.7453292519943295e-4;  ///< 0.01 deg
    double feed_ratio = 0.005;                     ///< relative, of feed and spindle speed
    double time_ratio = 0.01;                      ///< relative, of cycle times

    /// Chord error of curves: small compared with the tolerance, so that 0.9 of it is equal and 1.1
    /// differs, independent of the chords.
    double chord_mm() const { return 0.02 * position_mm; }
    double chord_rad() const { return 0.02 * direction_rad; }
};

}  // namespace trunnion::regression

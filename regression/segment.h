// One piece of a path as the comparer keeps it: a line or an arc, with feed, spindle, coolant,
// tool.
#pragma once

#include <array>
#include <cstdint>

#include "geometry/pose.h"

namespace trunnion::regression {

/// What a segment is to the comparer. A jump is no motion: the believed tip changes place (G43,
/// G49).
enum class SegmentKind : std::uint8_t { origin, rapid, feed, jump };

/// A point of a path with the orientation there. In the layer `path`: believed tip (mm) and unit
/// vector from tip to spindle, both in the table frame W. In the layer `axes`: X Y Z
/// of the gauge point (mm, machine) and the positions of the first three rotary axes (rad).
struct PathPoint {
    Vector3 position_mm = Vector3::Zero();
    Vector3 orientation = Vector3::Zero();
};

/// One segment, from the end of the one before it to `end`. Plain data: it is written to a
/// temporary file as it is. An arc has sweep_rad != 0; a helix rises linearly from start to end.
struct Segment {
    std::array<double, 3> end_mm{};
    std::array<double, 3> end_orientation{};
    std::array<double, 3> centre_mm{};
    std::array<float, 3> normal{};
    float feed_mm_min = 0.0F;   ///< 0 for rapids
    double sweep_rad = 0.0;     ///< counter-clockwise seen from the normal's tip
    float spindle_rpm = 0.0F;   ///< negative: M4
    std::uint32_t line = 0;     ///< from 1; 0 where there is none (goldens)
    std::uint16_t program = 0;  ///< index into PathRecord::programs
    std::uint16_t tool = 0;
    SegmentKind kind = SegmentKind::rapid;
    std::uint8_t mode = 0;  ///< PositioningMode in force
    bool coolant : 1 = false;
    bool turning : 1 = false;  ///< rotary axes move in this segment
    bool timed : 1 = false;    ///< its feed is that of its length and time: G93, or turning

    PathPoint end() const { return {Vector3(end_mm.data()), Vector3(end_orientation.data())}; }
    bool is_arc() const { return sweep_rad != 0.0; }
};

/// Tolerances of a comparison. Equal means: a monotone walk along both paths exists on which
/// position and orientation never differ by more than these (Frechet distance), so how a path is
/// cut into blocks does not matter.
struct Tolerances {
    double position_mm = 0.005;
    double direction_rad = 1.7453292519943295e-4;  ///< 0.01 deg
    double feed_ratio = 0.005;                     ///< relative, of feed and spindle speed
    double time_ratio = 0.01;                      ///< relative, of cycle times

    /// How finely curves are cut into chords: small against the tolerance, so that 0.9 of it is
    /// equal and 1.1 differs whatever the chords.
    double chord_mm() const { return 0.02 * position_mm; }
    double chord_rad() const { return 0.02 * direction_rad; }
};

}  // namespace trunnion::regression

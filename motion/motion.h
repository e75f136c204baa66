// The only output of the control: the axis motions that it commands.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/alarm.h"
#include "geometry/axes.h"
#include "geometry/parallel_axes.h"
#include "geometry/pose.h"

namespace trunnion::positioning {
class RotaryTransform;
}  // namespace trunnion::positioning

namespace trunnion::motion {

enum class MotionKind : std::uint8_t { rapid, linear, arc_cw, arc_ccw };  ///< G0 G1 G2 G3

/// A circular or helical path of the gauge point in machine coordinates.
struct ArcPath {
    Vector3 centre_mm = Vector3::Zero();
    Vector3 normal = Vector3::UnitZ();
    double turns = 0.0;      ///< signed turns, positive counter-clockwise seen from the tip of the
                             ///< normal; +-1 up to one turn
    double sweep_rad = 0.0;  ///< total angle with the same sign
};

/// Point of the arc at s in [0, 1], mm. Radius and height along the normal vary linearly between
/// start and end.
Vector3 point_on_arc(const ArcPath& arc, const Vector3& from, const Vector3& to, double s);

/// Length of an arc or helix: radius at its start, rise along the normal.
double arc_length_mm(const ArcPath& arc, const Vector3& from, const Vector3& to);

/// ArcPath::turns of a sweep: number of turns begun, at least one, with the sign of the sweep.
double turns_of(double sweep_rad);

/// A believed path that is neither a line nor an arc of the axes: straight for the tip in the
/// workpiece frame (G43.4), on a cylinder (G7.1), or polar (G12.1). s runs from 0 to 1.
class PathCurve {
  public:
    virtual ~PathCurve() = default;
    virtual AxisPositions at(double s) const = 0;
};

/// One move of the axes, in machine coordinates of the gauge point (mm, rad), including tool
/// length.
struct AxisMove {
    MotionKind kind = MotionKind::rapid;
    bool until_skip = false;  ///< G31: ends when the skip signal arrives
    bool gap_free = true;     ///< false: exact stop at the end (G9, G61)
    AxisPositions from, to;
    std::optional<ArcPath> arc;
    const PathCurve* curve = nullptr;  ///< valid during the call only
    double length_mm = 0.0;            ///< path length of the programmed point
    double duration_s = 0.0;           ///< with acceleration ramps
    double feed_mm_min = 0.0;          ///< feed between the ramps; 0 for G0
    int tool = 0;                      ///< T number of the tool in the spindle
    int tool_offset = 0;               ///< active H number
    double spindle_rpm = 0.0;          ///< signed: negative for M4
    bool coolant = false;
    PositioningMode mode = PositioningMode::none;
    Vector3 tool_vector_mm = Vector3::Zero();  ///< believed vector from the tip to the gauge point,
                                               ///< rotary axes at zero
    ParallelAxes parallel;                     ///< believed: U V W parallel to X Y Z
    const positioning::RotaryTransform* transform =
        nullptr;  ///< believed kinematics, for tip and tool direction in W
    int line = 0;
    std::uint64_t byte = 0;
    const std::string* program = nullptr;  ///< file name

    /// Axis positions at s in [0, 1] along the path.
    AxisPositions at(double s) const;
};

struct MoveResult {
    bool skipped = false;   ///< the skip signal arrived before the end
    AxisPositions stopped;  ///< axis positions at the skip signal
    double part = 1.0;      ///< fraction s of the move that was carried out
};

/// Receiver of the control's motions: the emulator, a trace, a comparison.
class MotionSink {
  public:
    virtual ~MotionSink() = default;
    virtual MoveResult move(const AxisMove& move) = 0;
    virtual void dwell(double /*duration_s*/) {}
    /// M codes passed on by the control (M0-M9, M19, clamps, unknown codes).
    virtual void m_code(int /*code*/) {}
};

}  // namespace trunnion::motion

// The one door out of the control: what it commands the axes to do.
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
    double turns =
        0.0;  ///< positive counter-clockwise seen from the normal's tip, +-1 up to one turn
    double sweep_rad = 0.0;  ///< total angle, same sign
};

/// On the arc at s in [0, 1]: the radius goes evenly from that of the start to that of the end, the
/// height along the normal too.
Vector3 point_on_arc(const ArcPath& arc, const Vector3& from, const Vector3& to, double s);

/// ArcPath::turns of a sweep: whole turns begun, at least one, with its sign.
double turns_of(double sweep_rad);

/// A believed path that is neither a line nor an arc of the axes: the tip is straight in the
/// workpiece frame (G43.4), or on a cylinder (G7.1), or polar (G12.1). s runs from 0 to 1.
class PathCurve {
  public:
    virtual ~PathCurve() = default;
    virtual AxisPositions at(double s) const = 0;
};

/// One move of the axes, in machine coordinates of the gauge point (mm, rad), tool length included.
struct AxisMove {
    MotionKind kind = MotionKind::rapid;
    bool until_skip = false;  ///< G31: stops where the skip signal comes
    bool gap_free = true;     ///< false: exact stop at the end (G9, G61)
    AxisPositions from, to;
    std::optional<ArcPath> arc;
    const PathCurve* curve = nullptr;  ///< valid during the call only
    double length_mm = 0.0;            ///< path length of the programmed point
    double duration_s = 0.0;           ///< ramps included
    double feed_mm_min = 0.0;          ///< between the ramps; 0 for G0
    int tool = 0;                      ///< T in the spindle
    int tool_offset = 0;               ///< H in force
    double spindle_rpm = 0.0;          ///< signed: negative is M4
    bool coolant = false;
    PositioningMode mode = PositioningMode::none;
    Vector3 tool_vector_mm =
        Vector3::Zero();    ///< believed: from tip to gauge point, rotaries at zero
    ParallelAxes parallel;  ///< believed: U V W beside X Y Z
    const positioning::RotaryTransform* transform =
        nullptr;  ///< believed kinematics, for tip and direction in W
    int line = 0;
    std::uint64_t byte = 0;
    const std::string* program = nullptr;  ///< name of the file

    /// Axis positions at s in [0, 1] along the path.
    AxisPositions at(double s) const;
};

struct MoveResult {
    bool skipped = false;   ///< the skip signal came before the end
    AxisPositions stopped;  ///< where, when it did
    double part = 1.0;      ///< of the move that was made: s
};

/// What the control drives: the emulator, a trace, a comparer.
class MotionSink {
  public:
    virtual ~MotionSink() = default;
    virtual MoveResult move(const AxisMove& move) = 0;
    virtual void dwell(double /*duration_s*/) {}
    /// M codes that the control passes on (M0-M9, M19, clamps, unknown ones).
    virtual void m_code(int /*code*/) {}
};

}  // namespace trunnion::motion

// The last stage before the sink: limits, clamps, durations. Keeps the positions where the axes
// stopped.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "controller/clamp.h"
#include "controller/frames.h"
#include "controller/run_record.h"
#include "motion/axis_limits.h"
#include "motion/dogleg.h"
#include "motion/motion.h"
#include "motion/pace.h"

namespace trunnion::controller {

/// An arc or helix of the tip in program coordinates, mm.
struct ProgramArc {
    Vector3 centre = Vector3::Zero();
    Vector3 normal = Vector3::UnitZ();
    double sweep_rad = 0.0;  ///< signed, about the normal
};

/// A computed target: the control's position, and the axis positions.
struct MoveTarget {
    offsets::ControlPosition program;  ///< program coordinates
    offsets::ControlPosition machine;  ///< mm and deg
    AxisPositions axes;                ///< mm and rad
};

/// How the axes move there: along a curve, on an arc, or straight.
struct CurveMove {
    const motion::PathCurve* curve = nullptr;
    std::optional<motion::ArcPath> arc;
    double length_mm = 0.0;       ///< path length of the programmed point
    double feed_length_mm = 0.0;  ///< path length to which F refers
};

/// Sends moves with everything active in `modal` and `frames`. OT0500, OT0501 beyond a stored
/// stroke limit, 9001 for a clamped axis, PS0011 and PS1202 without feed: all before any motion.
class AxisMover {
  public:
    /// `words`: of the block being executed, for the columns of alarms.
    AxisMover(const SortedWords& words, Modal& modal, Frames& frames, motion::MotionSink& sink);

    /// Takes limits and clamps of the axes.
    void configure(const ControlConfig& config);
    void parameters_changed();

    /// A straight move of the tip through the coordinate stages only. No output when the axes are
    /// already at the target.
    motion::MoveResult straight(motion::MotionKind kind, const offsets::ControlPosition& target);
    /// A straight move of the axes to a machine position (G53, G28); the program position is
    /// updated.
    void to_machine(motion::MotionKind kind, const offsets::ControlPosition& target);
    void arc(motion::MotionKind kind, const offsets::ControlPosition& target,
             const ProgramArc& arc);
    motion::MoveResult along(motion::MotionKind kind, const MoveTarget& target,
                             const CurveMove& way);
    void dwell(double duration_s);
    /// The block after an M code waits for its completion.
    void m_code(int code);
    /// The next move starts from rest.
    void stop() { pace_.stop(); }
    void clamp(Axis axis, bool clamped) { clamped_[index_of(axis)] = clamped; }
    /// The next move ends at the skip signal (G31).
    void until_skip(bool on) { move_.until_skip = on; }
    /// Before a run.
    void start_run();

    RunRecord record;
    motion::AxisLimits limits;  ///< from the configuration and 1783

  private:
    motion::MoveResult send(motion::MotionKind kind, const offsets::ControlPosition& program,
                            const offsets::ControlPosition& machine, double way);
    double duration(motion::MotionKind kind, double way) const;
    void take_marks();
    std::optional<motion::Dogleg> dogleg_of(const motion::AxisMove& move) const;
    void check_stroke(const AxisPositions& to) const;
    void check_clamps(const AxisPositions& to) const;

    const SortedWords& words_;
    Modal& modal_;
    Frames& frames_;
    motion::MotionSink& sink_;
    std::vector<ClampCode> clamps_;
    std::array<bool, axis_count> clamped_{};
    motion::Pace pace_;
    motion::AxisMove move_;  ///< the move to be sent; fields that rarely change are kept
};

}  // namespace trunnion::controller

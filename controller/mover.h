// Takes a commanded path to the axes: chamfers, corner radii and cutter compensation, then tool
// centre point control or G54.2, then the axes.
#pragma once

#include "controller/axis_mover.h"
#include "controller/tip_mover.h"
#include "cutter/cutter_path.h"

namespace trunnion::controller {

class Mover : private cutter::PathReceiver {
  public:
    Mover(const SortedWords& words, Modal& modal, Frames& frames, motion::MotionSink& sink);
    Mover(const Mover&) = delete;
    Mover& operator=(const Mover&) = delete;

    AxisMover axes;
    cutter::CutterPath cutter;

    RunRecord& record() { return axes.record; }
    void note(std::string text) { axes.record.note(std::move(text)); }
    void caution(const Caution& caution) { axes.record.cautions.add(caution); }

    /// A straight move (G0, G1, G31) or an arc of the tip to a program position; sent immediately.
    motion::MoveResult line(motion::MotionKind kind, const offsets::ControlPosition& target);
    void arc(motion::MotionKind kind, const offsets::ControlPosition& target,
             const ProgramArc& arc);
    /// Sends the block's move through corners and cutter compensation.
    void queue(const cutter::PathMove& move);
    /// A dwell or an M code in sequence; sent at once when nothing is buffered.
    void dwell(double duration_s);
    void m_code(int code);

    /// Before and after a block that changes frames or moves by itself. pause() sends the buffer;
    /// the program position is then that of the tool. resume() restores the programmed position.
    void pause();
    void resume(bool axes_moved);
    /// After a change of a coordinate stage: sends the buffer in the old frames, then derives the
    /// program position again.
    void frames_changed();

  private:
    void take(const cutter::PathOutput& out) override;
    void carry(const cutter::PathOutput& out);
    void queue_event(cutter::PathOutput event);

    Modal& modal_;
    Frames& frames_;
    TipMover tip_;
};

/// Unit vector along a linear axis.
inline Vector3 unit_along(Axis axis) {
    return Vector3::Unit(static_cast<Eigen::Index>(index_of(axis)));
}
/// `point` in the plane; the third coordinate is that of `p`.
Vector3 in_space(const motion::PlaneAxes& plane, const offsets::ControlPosition& p,
                 PlanePoint point);

}  // namespace trunnion::controller

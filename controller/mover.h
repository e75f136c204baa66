// What takes a commanded path to the axes: corners and cutter compensation, tool centre point
// control or G54.2, then the axes.
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

    /// A straight move (G0, G1, G31) or an arc of the tip to a program position; it goes out now.
    motion::MoveResult line(motion::MotionKind kind, const offsets::ControlPosition& target);
    void arc(motion::MotionKind kind, const offsets::ControlPosition& target,
             const ProgramArc& arc);
    /// The block's move goes through corners and cutter compensation.
    void queue(const cutter::PathMove& move);
    /// A dwell or an M code in its turn: at once when nothing waits.
    void dwell(double duration_s);
    void m_code(int code);

    /// Around a block that changes frames or moves by itself: everything waiting goes out and the
    /// program position is that of the tool; afterwards it is the programmed one again.
    void pause();
    void resume(bool axes_moved);
    /// After a coordinate stage changed: what waits goes out in the old frames, then the program
    /// position is derived anew.
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
/// `point` in the plane, the third coordinate from `p`.
Vector3 in_space(const motion::PlaneAxes& plane, const offsets::ControlPosition& p,
                 PlanePoint point);

}  // namespace trunnion::controller
